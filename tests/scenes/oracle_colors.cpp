#include "oracle_colors.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "lab/verify/expectation.hpp"

namespace gobo::scene {
namespace {

using Answers = std::vector<std::optional<std::array<double, 4>>>;

/// The values of one invocation.
evaluate::Invocations one_of(const evaluate::Program& program, const evaluate::Invocations& all,
                             std::size_t invocation) {
    evaluate::Invocations one = all;
    one.count = 1;
    for (const evaluate::Port& port : program.inputs) {
        const auto found = one.values.find(port.name);
        if (found == one.values.end() || found->second.size() == port.components) continue;
        std::vector<double> own;
        for (std::size_t c = 0; c < port.components; ++c)
            own.push_back(found->second[c * all.count + invocation]);
        found->second = std::move(own);
    }
    return one;
}

/// Uniform blocks as values by the names of their members, which the oracle takes.
void spell_out_blocks(const evaluate::Program& program, evaluate::Invocations& invocations) {
    for (const evaluate::Port& port : program.uniforms) {
        if (port.block < 0) continue;
        const std::string& block = program.uniform_blocks[static_cast<std::size_t>(port.block)].name;
        if (const auto bytes = invocations.blocks.find(block); bytes != invocations.blocks.end())
            invocations.values[port.name] = evaluate::numbers_in_block(port, bytes->second);
    }
}

std::array<double, 4> color_of(const evaluate::Outputs& outputs, const std::string& name,
                               std::size_t invocation) {
    std::array<double, 4> color{};
    const std::vector<double>& values = outputs.values.at(name);
    for (std::size_t c = 0; c < 4; ++c) color[c] = values[c * outputs.count + invocation];
    return color;
}

}  // namespace

Result<OracleColors> oracle_colors(const Family& family, const Key& key, const raster::Pipeline& pipeline,
                                   const raster::RasterObject& object) {
    OracleColors result;
    if (object.fragments.empty()) return result;
    GOBO_TRY(const auto varyings, evaluate::run<double>(pipeline.vertex, object.vertices));
    evaluate::Invocations inputs =
        raster::fragment_inputs(pipeline, object, raster::places_of(object, pipeline.needs_quads), varyings);
    std::map<std::string, Answers> answers;
    for (const evaluate::ImagePort& port : pipeline.fragment.images) {
        if (port.type.depth) continue;
        Answers& own = answers[port.name];
        own.resize(inputs.count);
        inputs.images[port.name] = [&own, image = inputs.images[port.name]](const auto& request) {
            const auto answer = image(request);
            std::optional<std::array<double, 4>>& first = own[request.invocation];
            if (!first && request.what == evaluate::ImageRequest::What::sample) first = answer;
            return answer;
        };
    }
    GOBO_TRY(const auto stage, evaluate::run<double>(pipeline.fragment, inputs));
    for (const auto& [sampler, own] : answers)
        inputs.images[sampler] = [&kept = own](const evaluate::ImageRequest& request) {
            return kept[request.invocation].value_or(std::array<double, 4>{0, 0, 0, 1});
        };
    GOBO_TRY(const auto even, evaluate::run<double>(pipeline.fragment, inputs));
    spell_out_blocks(pipeline.fragment, inputs);
    for (std::size_t i = 0; i < object.fragments.size(); ++i) {
        const std::size_t place = raster::own_place(object, i, pipeline.needs_quads);
        std::array<double, 4>& color = result.colors.emplace_back(color_of(stage, pipeline.color, place));
        if (stage.discarded[place]) continue;
        evaluate::Invocations one = one_of(pipeline.fragment, inputs, place);
        for (const auto& [sampler, own] : answers)
            one.images[sampler] = [color = own[place].value_or(std::array<double, 4>{0, 0, 0, 1})](
                                      const evaluate::ImageRequest&) { return color; };
        const auto expected = verify::ask_oracle(family, key, StageKind::fragment, pipeline.fragment, one);
        if (!expected) continue;
        for (const verify::Answer& answer : *expected) {
            if (answer.output != pipeline.color) continue;
            ++result.asked;
            const std::array<double, 4> own = color_of(even, pipeline.color, place);
            for (std::size_t c = 0; c < 4; ++c) {
                const double difference = answer.value[c] - own[c];
                color[c] += difference;
                result.largest =
                    std::max(result.largest, std::abs(difference) / std::max(std::abs(answer.value[c]), 1.0));
            }
        }
    }
    return result;
}

}  // namespace gobo::scene
