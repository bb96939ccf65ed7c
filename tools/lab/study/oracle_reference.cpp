#include "lab/study/oracle_reference.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "lab/oracle/model.hpp"
#include "lab/verify/expectation.hpp"
#include "lab/verify/feed.hpp"

namespace gobo::study {
namespace {

double number_at(const std::vector<std::byte>& bytes, std::uint32_t offset, evaluate::Scalar scalar) {
    if (offset + 4 > bytes.size()) return 0;
    std::uint32_t bits = 0;
    std::memcpy(&bits, bytes.data() + offset, sizeof bits);
    if (scalar == evaluate::Scalar::real) return std::bit_cast<float>(bits);
    if (scalar == evaluate::Scalar::unsigned_integer) return bits;
    return static_cast<std::int32_t>(bits);
}

/// Uniform blocks as values by name, as samples take them.
void spell_out_blocks(const evaluate::Program& program, evaluate::Invocations& invocations) {
    for (const evaluate::Port& port : program.uniforms) {
        if (port.block < 0 || invocations.values.contains(port.name)) continue;
        const std::string& block = program.uniform_blocks[static_cast<std::size_t>(port.block)].name;
        const auto bytes = invocations.blocks.find(block);
        if (bytes == invocations.blocks.end()) continue;
        std::vector<double>& values = invocations.values[port.name];
        for (const std::uint32_t offset : port.offsets)
            values.push_back(number_at(bytes->second, offset, port.scalar));
    }
}

/// An input of the stage that differs from fragment to fragment.
struct VaryingField {
    verify::Field field;
    const std::vector<double>* values = nullptr;
    std::size_t components = 0;
};

/// Sets a sample to one fragment after the other.
class FragmentSamples {
  public:
    FragmentSamples(const evaluate::Program& program, const evaluate::Invocations& inputs)
        : count_(inputs.count) {
        evaluate::Invocations first = inputs;
        first.count = 1;
        for (const evaluate::Port& port : program.inputs) {
            const auto found = inputs.values.find(port.name);
            if (found == inputs.values.end()) continue;
            if (const auto field = verify::field_of(port.name))
                fields_.push_back({*field, &found->second, port.components});
            std::vector<double>& one = first.values[port.name];
            one.resize(port.components);
            for (std::size_t c = 0; c < port.components; ++c) one[c] = found->second[c * count_];
        }
        spell_out_blocks(program, first);
        sample_ = verify::sample_of(program, first);
    }

    [[nodiscard]] bool are_known() const { return sample_.has_value(); }

    [[nodiscard]] const verify::Sample& at(std::size_t index) {
        std::vector<double> one;
        for (const VaryingField& varying : fields_) {
            one.resize(varying.components);
            for (std::size_t c = 0; c < varying.components; ++c)
                one[c] = (*varying.values)[c * count_ + index];
            varying.field.set(*sample_, one);
        }
        return *sample_;
    }

  private:
    std::size_t count_;
    std::vector<VaryingField> fields_;
    std::optional<verify::Sample> sample_;
};

}  // namespace

Result<std::optional<OracleAnswers>> ask_oracle_at(const Family& family, const Variant& variant,
                                                   const verify::SoftwareObject& object) {
    const auto model = oracle::model_of(family, variant.key);
    if (!model) return std::optional<OracleAnswers>{};
    const Result<evaluate::Invocations> inputs = verify::exact_fragment_inputs(variant.program, object);
    if (!inputs) return tl::unexpected(inputs.error());
    FragmentSamples samples(variant.program.fragment, *inputs);
    if (!samples.are_known()) return std::optional<OracleAnswers>{};
    OracleAnswers answers;
    for (std::size_t i = 0; i < inputs->count; ++i) {
        oracle::Decisions decisions;
        const auto expected = verify::expect(*model, StageKind::fragment, samples.at(i), decisions);
        const auto found = std::find_if(expected.begin(), expected.end(), [&](const auto& output) {
            return output.output == variant.program.color;
        });
        if (found == expected.end()) return std::optional<OracleAnswers>{};
        answers.colors.push_back({found->value[0], found->value[1], found->value[2]});
        answers.at_edge.push_back(decisions.open() > 0);
    }
    return std::optional<OracleAnswers>(std::move(answers));
}

}  // namespace gobo::study
