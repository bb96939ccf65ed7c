// What animations do to nodes, as bounds: no time is ever chosen.
#include <algorithm>

#include <fmt/format.h>

#include "scene/read_parts.hpp"

namespace gobo::scene {

void Interval::add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
}

namespace {

const Wanted times = {{"SCALAR"}, {Component::float_number}};
const std::vector<Component> float_or_normalized = {Component::float_number, Component::signed_byte,
                                                    Component::unsigned_byte, Component::signed_short,
                                                    Component::unsigned_short};

/// A curve over time. Between two keyframes it stays within the hull of its control points.
struct Curve {
    std::vector<double> times;
    Values values;
    bool is_cubic = false;
    std::size_t width = 1;  ///< numbers per keyframe, of one kind

    [[nodiscard]] double value(std::size_t keyframe, std::size_t part) const {
        return values.numbers[(is_cubic ? 3 * keyframe + 1 : keyframe) * width + part];
    }
    [[nodiscard]] double in_tangent(std::size_t keyframe, std::size_t part) const {
        return values.numbers[3 * keyframe * width + part];
    }
    [[nodiscard]] double out_tangent(std::size_t keyframe, std::size_t part) const {
        return values.numbers[(3 * keyframe + 2) * width + part];
    }
};

/// Calls `add` with every control point of one part: the keyframes and, of a cubic spline, the inner Bezier
/// points p0 + m0 dt / 3 and p1 - m1 dt / 3 of each segment, in whose hull the spline lies.
template <class Add>
void for_each_control(const Curve& curve, std::size_t part, const Add& add) {
    for (std::size_t i = 0; i < curve.times.size(); ++i) {
        add(curve.value(i, part));
        if (!curve.is_cubic || i + 1 == curve.times.size()) continue;
        const double third = (curve.times[i + 1] - curve.times[i]) / 3;
        add(curve.value(i, part) + curve.out_tangent(i, part) * third);
        add(curve.value(i + 1, part) - curve.in_tangent(i + 1, part) * third);
    }
}

void add_to_box(const Curve& curve, Box& box) {
    for (std::size_t part = 0; part < 3; ++part) {
        const auto axis = static_cast<glm::length_t>(part);
        for_each_control(curve, part, [&](double value) {
            box.low[axis] = std::min(box.low[axis], value);
            box.high[axis] = std::max(box.high[axis], value);
        });
    }
}

class AnimationReader {
  public:
    AnimationReader(Document& document, Accessors& accessors, Scene& scene)
        : document_(document), accessors_(accessors), scene_(scene) {}

    void read(const Value& animation) {
        const std::vector<Value> samplers = document_.objects(animation, "samplers");
        for (const Value& channel : document_.objects(animation, "channels")) {
            const int sampler = document_.required_index(channel, "sampler", samplers.size(), "samplers");
            const auto target = document_.object(channel, "target");
            if (!target) document_.error(path_to(channel, "target"), "is missing");
            if (document_.failed()) return;
            read_channel(*target, samplers[static_cast<std::size_t>(sampler)]);
        }
    }

  private:
    void read_channel(const Value& target, const Value& sampler) {
        const auto path = document_.string(target, "path");
        if (!path) document_.error(path_to(target, "path"), "is missing");
        const auto index = document_.index(target, "node", scene_.nodes.size(), "nodes");
        if (document_.failed() || !index) return;  // without a node an extension animates something else
        Node& node = scene_.nodes[static_cast<std::size_t>(*index)];
        if (node.has_matrix && path != "weights") {
            document_.error(target.path, fmt::format("animates nodes[{}], which has a matrix", *index));
            return;
        }
        if (!node.motion)
            node.motion = Motion{{node.translation, node.translation}, {node.scale, node.scale}, {}, {}, {}};
        if (path == "translation" || path == "scale") {
            const Curve curve = read_curve(sampler, {{"VEC3"}, {Component::float_number}}, 3);
            add_to_box(curve, path == "scale" ? node.motion->scale : node.motion->translation);
            node.motion->moves = true;
        } else if (path == "rotation") {
            static_cast<void>(read_curve(sampler, {{"VEC4"}, float_or_normalized}, 4));  // for its errors
            node.motion->rotates = true;
            node.motion->moves = true;
        } else if (path == "weights") {
            read_weights(target, sampler, node);
        } else if (path != "pointer") {
            document_.error(path_to(target, "path"), fmt::format("is '{}', which is unknown", *path),
                            "known: translation, rotation, scale, weights");
        }
    }

    void read_weights(const Value& target, const Value& sampler, Node& node) {
        const std::size_t count =
            node.mesh ? scene_.meshes[static_cast<std::size_t>(*node.mesh)].weights.size() : 0;
        if (count == 0) {
            document_.error(target.path, "animates the weights of a node whose mesh has no morph targets");
            return;
        }
        const Curve curve = read_curve(sampler, {{"SCALAR"}, float_or_normalized}, count);
        if (document_.failed()) return;
        if (node.motion->weights.empty()) {
            const std::vector<double>& rest =
                node.weights.empty() ? scene_.meshes[static_cast<std::size_t>(*node.mesh)].weights
                                     : node.weights;
            for (const double weight : rest) node.motion->weights.push_back({weight, weight});
        }
        for (std::size_t i = 0; i < count; ++i)
            for_each_control(curve, i, [&](double value) { node.motion->weights[i].add(value); });
    }

    /// `width` numbers per keyframe. Empty where something is wrong.
    Curve read_curve(const Value& sampler, const Wanted& wanted, std::size_t width) {
        Curve curve;
        const int input = document_.required_index(sampler, "input", accessors_.size(), "accessors");
        const int output = document_.required_index(sampler, "output", accessors_.size(), "accessors");
        curve.is_cubic =
            document_.choice(sampler, "interpolation", {"LINEAR", "STEP", "CUBICSPLINE"}) == "CUBICSPLINE";
        curve.width = width;
        const Values moments = accessors_.read(input, times, path_to(sampler, "input"));
        Values values = accessors_.read(output, wanted, path_to(sampler, "output"));
        if (document_.failed()) return {};
        const std::size_t expected = moments.count * (curve.is_cubic ? 3 : 1) * width / values.width;
        if (values.count != expected) {
            document_.error(path_to(sampler, "output"),
                            fmt::format("has {} elements, but {} keyframes need {}", values.count,
                                        moments.count, expected));
            return {};
        }
        for (std::size_t i = 1; i < moments.count; ++i) {
            if (moments.at(i, 0) > moments.at(i - 1, 0)) continue;
            document_.error(path_to(sampler, "input"), fmt::format("does not rise at keyframe {}", i));
            return {};
        }
        curve.times = moments.numbers;
        curve.values = std::move(values);
        return curve;
    }

    Document& document_;
    Accessors& accessors_;
    Scene& scene_;
};

}  // namespace

void read_animations(Document& document, Accessors& accessors, Scene& scene) {
    AnimationReader reader(document, accessors, scene);
    for (const Value& value : document.objects(document.root(), "animations")) {
        reader.read(value);
        if (document.failed()) return;
    }
}

}  // namespace gobo::scene
