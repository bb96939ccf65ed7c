#include "lab/sanitize/bounds.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <glm/geometric.hpp>

#include "core/text.hpp"
#include "lab/oracle/lights.hpp"
#include "lab/oracle/model.hpp"
#include "lab/verify/expectation.hpp"
#include "lab/verify/inputs.hpp"
#include "lab/verify/random_points.hpp"
#include "lab/verify/rounding.hpp"
#include "spirv/module.hpp"

namespace gobo::sanitize {
namespace {

/// Each of a few dozen factors and terms rounds by 6e-8, or by a few of that in an inverse square root on the
/// least accurate machine that the specification allows.
constexpr double kRoundings = 1 + 1e-5;

/// A radiance, a colour or a depth; the other outputs are positions and directions, which have a sign.
bool is_never_negative(std::string_view output, StageKind stage) {
    return stage == StageKind::fragment || output == "litRadiance" || output == "backRadiance";
}

/// The error of an eye-space coordinate that a vertex stage computes: four roundings of the sum's terms.
double position_error(const verify::Sample& sample) {
    glm::dvec3 largest = glm::abs(glm::dvec3(sample.model_view[3]));
    for (int column = 0; column < 3; ++column)
        largest += glm::abs(glm::dvec3(sample.model_view[column]) * sample.object_position[column]);
    return 4 * verify::kUnitRoundoff * glm::length(largest);
}

/// The light with its attenuation replaced by the largest that the error of the distance allows.
void bring_nearer(oracle::PointLight& light, const glm::dvec3& surface, double error) {
    const double distance = std::max(glm::distance(light.position, surface) - error, 0.0);
    const glm::dvec3& k = light.attenuation;
    light.attenuation = {k.x + distance * (k.y + distance * k.z), 0, 0};
}

/// The same for a light that is local by its w; the division by w rounds its place, too.
void bring_nearer(oracle::DirectionalOrPointLight& light, const glm::dvec3& surface, double error) {
    if (std::abs(light.position.w) < 0x1p-20) return;
    const glm::dvec3 place = glm::dvec3(light.position) / light.position.w;
    oracle::PointLight local{place, light.color, light.attenuation};
    bring_nearer(local, surface, error + verify::kUnitRoundoff * glm::length(place));
    light.attenuation = local.attenuation;
}

/// Of a length, each component is within it.
Interval interval_of(const Domain& domain) {
    Interval interval{domain.of_length ? -domain.high : domain.low, domain.high};
    for (const double also : domain.also) {
        interval.low = std::min(interval.low, also);
        interval.high = std::max(interval.high, also);
    }
    return interval;
}

/// What the lighting models of `lit` allow.
class LitBounds {
  public:
    LitBounds(const oracle::Model& model, StageKind stage, const evaluate::Program& program)
        : model_(model), stage_(stage), program_(program) {}

    [[nodiscard]] bool add(const InputField& field) {
        if (field.is_texture) return field.name == "shadowMaps" || field.name == "opacityMap";
        const auto known = verify::field_of(field.name);
        if (known) fields_.push_back({*known, field.first, field.components, field.pixel});
        return known.has_value() || field.name.starts_with("gl_");
    }

    /// Narrows a pixel's intervals, one of each component of each output in the program's order.
    void narrow(std::span<const double> point, int pixel, std::span<Interval> intervals) {
        for (const Known& field : fields_) {
            if (field.pixel >= 0 && field.pixel != pixel) continue;
            const auto numbers = point.subspan(field.first, field.components);
            scratch_.assign(numbers.begin(), numbers.end());
            field.access.set(sample_, scratch_);
        }
        bring_lights_nearer();
        oracle::Decisions decisions;
        const std::vector<verify::Expected> outputs = verify::expect(model_, stage_, sample_, decisions);
        std::size_t at = 0;
        for (const evaluate::Port& port : program_.outputs) {
            const auto expected =
                std::find_if(outputs.begin(), outputs.end(),
                             [&](const verify::Expected& one) { return one.output == port.name; });
            if (expected != outputs.end()) narrow(*expected, intervals.subspan(at, port.components));
            at += port.components;
        }
    }

  private:
    struct Known {
        verify::Field access;
        std::size_t first;
        std::size_t components;
        int pixel;
    };

    void bring_lights_nearer() {
        oracle::Scene& scene = sample_.scene;
        const bool is_vertex = stage_ == StageKind::vertex;
        const glm::dvec3 surface =
            is_vertex ? glm::dvec3(sample_.model_view * glm::dvec4(sample_.object_position, 1))
                      : sample_.surface.position;
        const double error = is_vertex ? position_error(sample_) : 0;
        for (auto& light : scene.directional_or_point) bring_nearer(light, surface, error);
        if (!is_vertex) return;
        for (auto& light : scene.point) bring_nearer(light, surface, error);
        for (auto& light : scene.spot) bring_nearer(light, surface, error);
    }

    void narrow(const verify::Expected& expected, std::span<Interval> intervals) const {
        for (std::size_t c = 0; c < intervals.size(); ++c) {
            const double most = std::max(expected.largest[c], std::abs(expected.value[c])) * kRoundings;
            if (!std::isfinite(most)) continue;
            intervals[c].high = std::min(intervals[c].high, most);
            intervals[c].low =
                is_never_negative(expected.output, stage_) ? 0 : std::max(intervals[c].low, -most);
        }
    }

    const oracle::Model model_;
    StageKind stage_;
    const evaluate::Program& program_;
    std::vector<Known> fields_;
    verify::Sample sample_;
    std::vector<double> scratch_;
};

/// Null where the oracle does not know the key's model or what the stage reads.
std::shared_ptr<LitBounds> lit_bounds(const Family& family, const Key& key, StageKind stage,
                                      const evaluate::Program& program, const InputSpace& space) {
    auto model = oracle::model_of(family, key);
    if (!model || model->takes_derivatives()) return nullptr;  // which hang on what other pixels are given
    // A shadow only takes light away.
    model->directional_shadows = model->point_shadows = model->spot_shadows = 0;
    auto bounds = std::make_shared<LitBounds>(*model, stage, program);
    for (const InputField& field : space.fields)
        if (!bounds->add(field)) return nullptr;
    return bounds;
}

}  // namespace

DepthPromise depth_promise_of(std::span<const std::uint32_t> words) {
    const auto module = spirv::read_module(words);
    if (!module) return DepthPromise::none;
    for (const spirv::Instruction& instruction : module->instructions) {
        if (instruction.opcode != spv::OpExecutionMode) continue;
        if (instruction.word(2) == spv::ExecutionModeDepthGreater) return DepthPromise::greater;
        if (instruction.word(2) == spv::ExecutionModeDepthLess) return DepthPromise::less;
        if (instruction.word(2) == spv::ExecutionModeDepthUnchanged) return DepthPromise::unchanged;
    }
    return DepthPromise::none;
}

OutputBounds::OutputBounds(const Family& family, const Key& key, StageKind stage,
                           const evaluate::Program& program, const InputSpace& space, DepthPromise promise)
    : promise_(promise) {
    if (auto model = lit_bounds(family, key, stage, program, space))
        narrow_ = [model](auto point, int pixel, auto intervals) { model->narrow(point, pixel, intervals); };
    for (const evaluate::Port& output : program.outputs) {
        Interval interval;
        if (output.name == "gl_FragDepth") {
            interval = {0, 1};
            depth_ = declared_.size();
        }
        // OpenGL leaves points of any other size undefined.
        if (output.name == "gl_PointSize") interval.low = kLeastAboveZero;
        const Domain* domain = verify::domain_of(family.domains, output.name);
        // A varying's domain is what the fragment stage may be given; what a vertex stage makes of matrices
        // within theirs can be anything.
        if (stage == StageKind::fragment && domain != nullptr) interval = interval_of(*domain);
        const std::string name = without_subscripts(output.name);
        for (std::size_t i = 0; i < output.components; ++i) {
            const Domain* const own =
                stage == StageKind::fragment ? domain_of_component(family.domains, name, i) : nullptr;
            declared_.push_back(own != nullptr ? interval_of(*own) : interval);
        }
    }
    pixels_ = space.pixels;
    for (const InputField& field : space.fields)
        if (field.name == "gl_FragCoord") own_depths_.push_back(field.first + 2);
}

void OutputBounds::keep_promise(double own_depth, Interval& depth) const {
    depth.promise = promise_;
    // A machine that flushes denormal numbers reads 0 for one.
    const double seen = own_depth < std::numeric_limits<float>::min() ? 0 : own_depth;
    if (promise_ == DepthPromise::greater || promise_ == DepthPromise::unchanged) depth.low = seen;
    if (promise_ == DepthPromise::less || promise_ == DepthPromise::unchanged) depth.high = own_depth;
}

std::vector<Interval> OutputBounds::at(const PointSet& points) {
    std::vector<Interval> intervals;
    intervals.reserve(points.count * pixels_ * declared_.size());
    for (std::size_t i = 0; i < points.count * pixels_; ++i) {
        const std::span<const double> point = points[i / pixels_];
        const std::size_t pixel = i % pixels_;
        intervals.insert(intervals.end(), declared_.begin(), declared_.end());
        const auto here = std::span(intervals).last(declared_.size());
        if (narrow_) narrow_(point, static_cast<int>(pixel), here);
        if (depth_ && !own_depths_.empty())
            keep_promise(point[own_depths_[std::min(pixel, own_depths_.size() - 1)]], here[*depth_]);
    }
    return intervals;
}

}  // namespace gobo::sanitize
