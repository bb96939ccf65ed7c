// The ubershader at the hard cases of `lit`: it gives what the permutation gives that was made for the case,
// and nothing undefined happens in it.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "compose/compose.hpp"
#include "compose/search_path.hpp"
#include "core/file_system.hpp"
#include "family/read_family.hpp"
#include "lab/evaluate/images.hpp"
#include "lab/oracle/model.hpp"
#include "lab/sanitize/sanitize.hpp"
#include "lit_cases.hpp"
#include "settings.hpp"
#include "uber_ports.hpp"
#include "uber_values.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

const DiskFileSystem disk;

Family lit_family() {
    return read_family(disk.read(GOBO_SOURCE_DIR "/templates/lit.toml").value(), "templates/lit.toml")
        .value();
}

/// The fragment stage of the ubershader's key.
evaluate::Program fragment_of(const Family& family, const Key& key) {
    SearchPath search;
    uber::add_pieces(search);
    const Composition composition = compose(family, {key}, search, Dialect::own).value();
    ValidateOptions options;
    options.keep_spirv = true;
    options.debug_information = true;
    const Validated validated = validate(family, composition, options);
    const auto stage = static_cast<std::size_t>(composition.permutations.front().stages[StageKind::fragment]);
    return evaluate::decode(validated.stages[stage].spirv).value();
}

/// What the ubershader reads where the permutation reads `given`; 0 what the permutation does not read.
evaluate::Invocations switched(const evaluate::Program& uber, const oracle::Model& model,
                               const evaluate::Invocations& given) {
    evaluate::Invocations result;
    result.count = given.count;
    for (const auto* ports : {&uber.inputs, &uber.uniforms})
        for (const evaluate::Port& port : *ports) {
            const auto from = uber::uber_port(model, port.name);
            const auto value = given.values.find(from ? from->lit_name : port.name);
            std::vector<double>& numbers = result.values[port.name];
            if (value != given.values.end()) numbers = value->second;
            numbers.resize(port.components, from ? from->number : 0);
        }
    for (const evaluate::ImagePort& image : uber.images) {
        const auto own = given.images.find(image.name);
        result.images[image.name] = own != given.images.end() ? own->second : [](const auto& request) {
            return evaluate::answer({0, 0, 0, 1}, request);
        };
    }
    return result;
}

class UberCase : public testing::TestWithParam<Case> {
  protected:
    /// The fragment stage that does what the key of `lit` says.
    const evaluate::Program& uber_of(const Key& key) {
        const Key own = scene::uber_key(uber_, lit_, key, scene::UberLights::switched);
        const auto [place, is_new] = programs_.try_emplace(own);
        if (is_new) place->second = fragment_of(uber_, own);
        return place->second;
    }

    /// One point, on one machine: the same colour but for eight roundings, and nothing undefined.
    void expect_same(const LitUnderTest& lit, std::size_t permutation, const Inputs& point,
                     sanitize::Machine machine) {
        const Key& key = lit.composition().permutations[permutation].key;
        const oracle::Model model = oracle::model_of(lit_, key).value();
        const evaluate::Program& uber = uber_of(key);
        const auto invocation = switched(uber, model, lit.inputs_of(permutation, point, machine).fragment);
        const auto outputs = evaluate::run<float>(uber, invocation, sanitize::options_of(machine)).value();
        const Shaded expected = lit.shade_unwatched(permutation, point, machine);
        ASSERT_EQ(outputs.discarded.front(), expected.is_discarded);
        const std::vector<double>& color = outputs.values.at("fragmentColor");
        const double brightest =
            std::max(1.0, *std::max_element(expected.color.begin(), expected.color.end()));
        for (std::size_t c = 0; c < 4 && !expected.is_discarded; ++c)
            ASSERT_LE(std::abs(color[c] - expected.color[c]), 1e-6 * brightest) << "channel " << c;
        const auto findings = sanitize::find_traps(uber, invocation, machine);
        ASSERT_TRUE(findings);
        for (const sanitize::Finding& finding : *findings)
            ADD_FAILURE() << finding.place.file << ":" << finding.place.line << ": " << to_text(finding);
    }

    const Family lit_ = lit_family();
    const Family uber_ = uber::family();

  private:
    std::map<Key, evaluate::Program> programs_;
};

TEST_P(UberCase, IsThatOfThePermutation) {
    const Case& tested = GetParam();
    const std::string where = tested.where.empty() ? "" : " && (" + tested.where + ")";
    const LitUnderTest lit("shading == fragment && n_dot_l == fragment" + where, tested.features, {}, 2);
    for (std::size_t permutation = 0; permutation < lit.size(); ++permutation)
        for (std::size_t point = 0; point < tested.points.size(); ++point)
            for (const sanitize::Machine machine : {sanitize::Machine::ieee, sanitize::Machine::flushed}) {
                SCOPED_TRACE(fmt::format("{} at point {}", lit.key(permutation), point));
                expect_same(lit, permutation, tested.points[point], machine);
                if (HasFailure()) return;
            }
}

/// Cases that no permutation knows which is shaded per fragment are not for the ubershader.
std::vector<Case> cases_per_fragment() {
    std::vector<Case> cases = lit_cases();
    std::erase_if(cases, [](const Case& tested) {
        return tested.where.find("shading == vertex") != std::string::npos ||
               tested.where.find("shading == flat") != std::string::npos ||
               tested.where.find("shading == hybrid") != std::string::npos ||
               tested.where.find("n_dot_l == vertex") != std::string::npos;
    });
    return cases;
}

INSTANTIATE_TEST_SUITE_P(HardCases, UberCase, testing::ValuesIn(cases_per_fragment()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
}  // namespace gobo
