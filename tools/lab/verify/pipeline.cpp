#include "lab/verify/pipeline.hpp"

#include <algorithm>

namespace gobo::verify {

std::vector<evaluate::Port> Pipeline::given() const {
    std::map<std::string, evaluate::Port> by_name;
    for (const auto* ports : {&vertex.inputs, &vertex.uniforms, &fragment.uniforms})
        for (const evaluate::Port& port : *ports) by_name.emplace(port.name, port);
    for (const evaluate::Port& port : fragment.inputs)
        if (port.name.starts_with("gl_")) by_name.emplace(port.name, port);
    std::vector<evaluate::Port> ports;
    for (auto& [name, port] : by_name) ports.push_back(std::move(port));
    return ports;
}

evaluate::Invocations part_of(const evaluate::Program& program, const evaluate::Invocations& points) {
    evaluate::Invocations part;
    part.count = points.count;
    for (const auto* ports : {&program.inputs, &program.uniforms})
        for (const evaluate::Port& port : *ports)
            if (const auto found = points.values.find(port.name); found != points.values.end())
                part.values.insert(*found);
    for (const evaluate::ImagePort& image : program.images)
        if (const auto found = points.images.find(image.name); found != points.images.end())
            part.images.insert(*found);
    return part;
}

Result<FragmentsAtPoints> fragments_at_points(const Pipeline& pipeline, const evaluate::Invocations& points) {
    Result<evaluate::Outputs> vertices =
        evaluate::run<double>(pipeline.vertex, part_of(pipeline.vertex, points));
    if (!vertices) return tl::unexpected(vertices.error());
    evaluate::Invocations fragments = part_of(pipeline.fragment, points);
    for (const Varying& varying : pipeline.link.varyings)
        fragments.values[varying.input] = vertices->values.at(varying.output);
    return FragmentsAtPoints{std::move(fragments), std::move(*vertices)};
}

Result<PointOutputs> run_at_points(const Pipeline& pipeline, const evaluate::Invocations& points) {
    const Result<FragmentsAtPoints> fragments = fragments_at_points(pipeline, points);
    if (!fragments) return tl::unexpected(fragments.error());
    const auto shaded = evaluate::run<double>(pipeline.fragment, fragments->invocations);
    if (!shaded) return tl::unexpected(shaded.error());
    PointOutputs outputs(shaded->values.begin(), shaded->values.end());
    std::vector<double>& discards = outputs["discard"];
    for (const bool is_discarded : shaded->discarded) discards.push_back(is_discarded ? 1 : 0);
    for (auto& [name, values] : outputs)
        for (std::size_t k = 0; name != "discard" && k < values.size(); ++k)
            if (shaded->discarded[k % points.count]) values[k] = 0;
    const auto position = fragments->vertices.values.find("gl_Position");
    if (position != fragments->vertices.values.end()) outputs.insert(*position);
    return outputs;
}

}  // namespace gobo::verify
