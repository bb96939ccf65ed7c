#include "lab/verify/on_mesh.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "lab/verify/comparison.hpp"
#include "lab/verify/feed.hpp"

namespace gobo::verify {
namespace {

constexpr int kSide = 16;

/// A mesh on the screen: the covered pixels, and the vertices of the triangles that cover them.
struct Drawn {
    std::vector<Sample> vertices;
    std::vector<glm::dvec4> positions;
    std::vector<std::uint32_t> indices;
    std::vector<Fragment> fragments;
    std::vector<FragmentPlace> places;
};

std::vector<glm::dvec4> clip_positions(const Sample& draw, const Mesh& mesh) {
    std::vector<glm::dvec4> positions;
    for (const glm::vec3& position : mesh.positions)
        positions.push_back(draw.projection * (draw.model_view * glm::dvec4(position, 1)));
    return positions;
}

/// Gives the fragments' triangles their vertices, each once.
void keep_vertices(const Sample& draw, const Mesh& mesh, const std::vector<glm::dvec4>& positions,
                   Drawn& drawn) {
    std::map<std::uint32_t, std::uint32_t> kept;
    std::optional<std::uint32_t> last;  // fragments come triangle by triangle
    for (Fragment& fragment : drawn.fragments) {
        if (last != fragment.triangle) {
            last = fragment.triangle;
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = mesh.indices[3 * std::size_t{fragment.triangle} + corner];
                const auto next = static_cast<std::uint32_t>(drawn.vertices.size());
                const auto [place, is_new] = kept.try_emplace(vertex, next);
                drawn.indices.push_back(place->second);
                if (!is_new) continue;
                drawn.vertices.push_back(at_vertex(draw, mesh, vertex));
                drawn.positions.push_back(positions[vertex]);
            }
        }
        fragment.triangle = static_cast<std::uint32_t>(drawn.indices.size() / 3 - 1);
    }
}

Drawn draw_mesh(const Sample& draw, const Mesh& mesh, bool in_quads) {
    Drawn drawn;
    const std::vector<glm::dvec4> positions = clip_positions(draw, mesh);
    drawn.fragments = rasterise(positions, mesh.indices, kSide, kSide);
    std::erase_if(drawn.fragments, [](const Fragment& fragment) { return !fragment.is_covered; });
    keep_vertices(draw, mesh, positions, drawn);
    drawn.places = places_of({drawn.fragments, drawn.indices, drawn.positions, kSide, kSide}, in_quads);
    return drawn;
}

/// Values of a varying, component by component, of all vertices or all places.
using Values = std::vector<double>;

Values interpolated(const Values& at_vertices, const Drawn& drawn, std::uint32_t components,
                    Interpolation interpolation) {
    const std::size_t count = drawn.places.size();
    Values values(components * count);
    for (std::uint32_t c = 0; c < components; ++c) {
        const double* first = &at_vertices[c * drawn.vertices.size()];
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t* corner = &drawn.indices[3 * std::size_t{drawn.places[i].fragment->triangle}];
            values[c * count + i] = interpolated({first[corner[0]], first[corner[1]], first[corner[2]]},
                                                 drawn.places[i].weights, interpolation);
        }
    }
    return values;
}

Diagnostics unknown(const std::string& varying) {
    return fail(Fault::input, fmt::format("the oracle does not say what '{}' ought to be", varying),
                "expect it of the vertex stage (tools/verify/expectation.cpp), and give samples a field for "
                "it "
                "(feed.cpp)")
        .value();
}

/// How the oracle would interpolate a varying; nothing where it does not know it.
std::optional<Interpolation> interpolation_of(const std::string& name, const std::vector<Expected>& vertex) {
    const auto found = std::find_if(vertex.begin(), vertex.end(),
                                    [&](const Expected& expected) { return expected.output == name; });
    if (found == vertex.end()) return std::nullopt;
    return found->is_flat ? Interpolation::flat : Interpolation::perspective;
}

std::vector<Sample> in(Precision precision, std::vector<Sample> samples) {
    return precision == Precision::fp64 ? samples : rounded_to_float(std::move(samples));
}

Values in(Precision precision, Values values) {
    if (precision == Precision::fp32)
        for (double& value : values) value = static_cast<float>(value);
    return values;
}

/// Sets a field of the samples at all places.
bool set_field(std::vector<Sample>& samples, const std::string& name, const Values& values) {
    const std::optional<Field> field = field_of(name);
    if (!field) return false;
    const std::size_t components = values.size() / samples.size();
    for (std::size_t i = 0; i < samples.size(); ++i) {
        std::vector<double> one;
        for (std::size_t c = 0; c < components; ++c) one.push_back(values[c * samples.size() + i]);
        field->set(samples[i], one);
    }
    return true;
}

/// The draw's sample at each place, without its varyings.
std::vector<Sample> samples_at(const Sample& draw, const Drawn& drawn) {
    std::vector<Sample> samples(drawn.places.size(), draw);
    const auto position = field_of("gl_FragCoord");
    const auto front = field_of("gl_FrontFacing");
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const FragmentPlace& place = drawn.places[i];
        const std::array<double, 4> window = window_position(place);
        if (position) position->set(samples[i], {window.begin(), window.end()});
        if (front) front->set(samples[i], {place.fragment->is_front_facing ? 1.0 : 0.0});
    }
    return samples;
}

/// Checks one permutation on one mesh.
class MeshCheck {
  public:
    MeshCheck(const Pipeline& pipeline, const oracle::Model& model, const Mesh& mesh, std::uint64_t seed)
        : pipeline_(pipeline),
          model_(model),
          draw_(make_draw(model, mesh, seed)),
          drawn_(draw_mesh(draw_, mesh, pipeline.link.needs_quads)),
          vertex_marks_(drawn_.vertices.size()),
          fragment_marks_(drawn_.fragments.size()) {}

    Result<std::vector<StageReport>> run() && {
        for (const Precision precision : {Precision::fp64, Precision::fp32})
            if (const Result<bool> done = run(precision); !done) return tl::unexpected(done.error());
        count(vertex_marks_, vertex_report_);
        count(fragment_marks_, fragment_report_);
        return std::vector<StageReport>{std::move(vertex_report_), std::move(fragment_report_)};
    }

  private:
    Result<bool> run(Precision precision) {
        if (drawn_.fragments.empty()) return true;  // a plane seen edge on
        const std::vector<Sample> vertices = in(precision, drawn_.vertices);
        const auto invocations = feed(pipeline_.vertex, vertices);
        if (!invocations) return tl::unexpected(invocations.error());
        Comparison comparison(pipeline_.vertex, StageKind::vertex, model_, precision, vertex_report_);
        const auto outputs = comparison.run(*invocations);
        if (!outputs) return tl::unexpected(outputs.error());
        std::vector<Expected> expected;
        for (std::size_t i = 0; i < vertices.size(); ++i)
            expected = comparison.judge(vertices[i], *invocations, *outputs, i, vertex_marks_, i);
        return check_fragments(*outputs, expected, precision);
    }

    /// `outputs` of the vertex stage, of which the oracle expects such as `expected`.
    Result<bool> check_fragments(const evaluate::Outputs& outputs, const std::vector<Expected>& expected,
                                 Precision precision) {
        std::vector<Sample> samples = samples_at(draw_, drawn_);
        for (const Varying& varying : pipeline_.link.varyings) {
            const auto own = outputs.values.find(varying.input);
            const auto interpolation = interpolation_of(varying.input, expected);
            if (own == outputs.values.end() || !interpolation) return tl::unexpected(unknown(varying.input));
            const Values values = interpolated(own->second, drawn_, varying.components, *interpolation);
            if (!set_field(samples, varying.input, values)) return tl::unexpected(unknown(varying.input));
        }
        samples = in(precision, std::move(samples));
        auto invocations = feed(pipeline_.fragment, samples);
        if (!invocations) return tl::unexpected(invocations.error());
        for (const Varying& varying : pipeline_.link.varyings)
            invocations->values[varying.input] =
                in(precision, interpolated(outputs.values.at(varying.output), drawn_, varying.components,
                                           varying.interpolation));
        return judge_fragments(samples, *invocations, precision);
    }

    Result<bool> judge_fragments(const std::vector<Sample>& samples, const evaluate::Invocations& invocations,
                                 Precision precision) {
        Comparison comparison(pipeline_.fragment, StageKind::fragment, model_, precision, fragment_report_);
        const auto outputs = comparison.run(invocations);
        if (!outputs) return tl::unexpected(outputs.error());
        for (std::size_t i = 0; i < drawn_.fragments.size(); ++i) {
            const std::size_t own = own_place(drawn_.fragments[i], i, pipeline_.link.needs_quads);
            (void)comparison.judge(samples[own], invocations, *outputs, own, fragment_marks_, i);
        }
        return true;
    }

    const Pipeline& pipeline_;
    const oracle::Model& model_;
    Sample draw_;
    Drawn drawn_;
    Marks vertex_marks_;
    Marks fragment_marks_;
    StageReport vertex_report_;
    StageReport fragment_report_;
};

}  // namespace

Result<std::vector<StageReport>> check_on_mesh(const Pipeline& pipeline, const oracle::Model& model,
                                               const Mesh& mesh, std::uint64_t seed) {
    return MeshCheck(pipeline, model, mesh, seed).run();
}

}  // namespace gobo::verify
