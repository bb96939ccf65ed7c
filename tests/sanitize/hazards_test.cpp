// Every planted hazard is found, and nothing in its guarded twin.
#include "hazards.hpp"

#include <ostream>

#include <gtest/gtest.h>

#include "lab/sanitize/lost_numbers.hpp"

namespace gobo {
namespace {

std::string shader_of(const Hazard& row, const HazardSource& source) {
    if (row.setting == Setting::vulkan)
        return "#version 450\nlayout(location = 0) in float x; layout(location = 0) out vec4 c;\n" +
               source.declarations + "\nvoid main() {\nc = vec4(0);\n" + source.body + "\n}\n";
    const bool is_vertex = row.setting == Setting::vertex;
    const bool is_es = row.setting == Setting::mediump || row.setting == Setting::mediump_flushed;
    const std::string flat = is_vertex ? "in int" : "flat in int";
    std::string text =
        is_es ? "#version 300 es\nprecision mediump float;\nprecision highp int;\n" : "#version 450\n";
    text += "in float x; in float y; in vec3 v; in vec3 w; in vec2 uv; in vec4 v4;\n" + flat + " i; " + flat +
            " j;\nuniform mat3 M; uniform float table[4]; uniform bool on;\n";
    if (!is_es)
        text +=
            "uniform sampler2D map; uniform samplerCube sky; uniform sampler2DArray layers;\n"
            "uniform sampler3D vol; uniform usampler2D uids; uniform sampler2DShadow shadow;\n"
            "uniform samplerBuffer buf; uniform sampler2DMS ms; uniform sampler1D ramp;\n"
            "uniform samplerCubeShadow cubeShadow; uniform sampler2DRect rect;\n";
    if (!is_vertex) text += "layout(location = 0) out vec4 c;\n";
    const bool writes_color = !is_vertex && row.setting != Setting::no_color;
    return text + source.declarations + "\nvoid main() {\n" + (writes_color ? "c = vec4(0);\n" : "") +
           source.body + "\n}\n";
}

std::string file_of(const Hazard& row) {
    return row.setting == Setting::vertex ? "hazard.vert" : "hazard.frag";
}

sanitize::SanitizeReport report_of(const Hazard& row, const HazardSource& source) {
    sanitize::SanitizeOptions options;
    if (row.message.starts_with("a loop")) options.points = 64;  // each takes 65,536 turns
    if (row.setting == Setting::mediump) options.machines = {sanitize::Machine::mediump};
    if (row.setting == Setting::mediump_flushed)
        options.machines = {sanitize::Machine::mediump, sanitize::Machine::mediump_flushed};
    if (row.setting == Setting::every_machine)
        options.machines.assign(sanitize::kMachines.begin(), sanitize::kMachines.end());
    return sanitized_text(file_of(row), shader_of(row, source), options, row.domains);
}

std::set<std::string> messages_of(const sanitize::SanitizeReport& report) {
    std::set<std::string> messages;
    for (const sanitize::SharedFinding& shared : report.findings) messages.insert(shared.finding.message);
    return messages;
}

class Hazards : public testing::TestWithParam<Hazard> {};

TEST_P(Hazards, IsFoundUnlessGuarded) {
    const Hazard& row = GetParam();
    const sanitize::SanitizeReport report = report_of(row, row.hazard);
    const std::set<std::string> found = messages_of(report);
    EXPECT_TRUE(found.contains(row.message)) << testing::PrintToString(found);
    EXPECT_EQ(messages_of(report_of(row, row.guarded)), std::set<std::string>());
    if (row.message == sanitize::kLostNumber) {
        EXPECT_EQ(not_replayed(file_of(row), shader_of(row, row.hazard), report), Lines{});
    }
}

INSTANTIATE_TEST_SUITE_P(Texture, Hazards, testing::ValuesIn(texture_hazards()), row_name);
INSTANTIATE_TEST_SUITE_P(UndefinedValue, Hazards, testing::ValuesIn(undefined_value_hazards()), row_name);
INSTANTIATE_TEST_SUITE_P(Constant, Hazards, testing::ValuesIn(constant_hazards()), row_name);
INSTANTIATE_TEST_SUITE_P(Precision, Hazards, testing::ValuesIn(precision_hazards()), row_name);
INSTANTIATE_TEST_SUITE_P(LostNumber, Hazards, testing::ValuesIn(lost_number_hazards()), row_name);
INSTANTIATE_TEST_SUITE_P(Arithmetic, Hazards, testing::ValuesIn(arithmetic_hazards()), row_name);

}  // namespace

std::ostream& operator<<(std::ostream& stream, const Hazard& hazard) {
    return stream << hazard.name;
}

}  // namespace gobo
