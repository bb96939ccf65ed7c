// Messages for other programs: every bad input of cases/ answered in JSON and in SARIF, whatever way gobo
// ends.
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <tuple>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "case_file.hpp"
#include "core/diagnostic.hpp"
#include "core/file_system.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

using Json = nlohmann::json;
using Type = Json::value_t;

const std::string cases_folder = GOBO_SOURCE_DIR "/tests/errors/cases";

/// What the schema of SARIF 2.1.0 says of an object's property, of those that gobo writes.
struct Property {
    const char* name;
    Type type;
    bool is_required = false;
    const char* object = "";  ///< what it holds, or the elements of the array that it is
};

/// By the schema's definitions (https://json.schemastore.org/sarif-2.1.0.json). None allows other properties.
const std::map<std::string, std::vector<Property>> kSchema = {
    {"log", {{"$schema", Type::string}, {"version", Type::string, true}, {"runs", Type::array, true, "run"}}},
    {"run",
     {{"tool", Type::object, true, "tool"},
      {"columnKind", Type::string},
      {"invocations", Type::array, false, "invocation"},
      {"results", Type::array, false, "result"}}},
    {"tool", {{"driver", Type::object, true, "driver"}}},
    {"driver",
     {{"name", Type::string, true}, {"version", Type::string}, {"rules", Type::array, false, "rule"}}},
    {"rule", {{"id", Type::string, true}, {"shortDescription", Type::object, false, "message"}}},
    {"invocation", {{"executionSuccessful", Type::boolean, true}, {"exitCode", Type::number_unsigned}}},
    {"result",
     {{"ruleId", Type::string},
      {"ruleIndex", Type::number_unsigned},
      {"level", Type::string},
      {"message", Type::object, true, "message"},
      {"locations", Type::array, false, "location"},
      {"properties", Type::object, false, "bag"}}},
    {"message", {{"text", Type::string, true}}},
    {"location", {{"physicalLocation", Type::object, false, "physical"}}},
    {"physical",
     {{"artifactLocation", Type::object, false, "artifact"}, {"region", Type::object, false, "region"}}},
    {"artifact", {{"uri", Type::string}}},
    {"region",
     {{"startLine", Type::number_unsigned},
      {"startColumn", Type::number_unsigned},
      {"snippet", Type::object, false, "message"}}},
    {"bag", {{"key", Type::string}, {"more_keys", Type::number_unsigned}, {"help", Type::string}}},
};

/// What the schema forbids, by where it stands.
void find_faults(const Json& value, const std::string& object, const std::string& at,
                 std::vector<std::string>& faults) {
    if (!value.is_object()) return faults.push_back(at + " is no object");
    const std::vector<Property>& properties = kSchema.at(object);
    for (const auto& [name, held] : value.items()) {
        const auto known = std::ranges::find(properties, name, &Property::name);
        const std::string here = at + "." + name;
        if (known == properties.end()) {
            faults.push_back(here + " is not in the schema");
        } else if (held.type() != known->type) {
            faults.push_back(here + " has another type");
        } else if (std::string_view(known->object).empty()) {
            continue;
        } else if (held.is_array()) {
            for (const Json& element : held) find_faults(element, known->object, here, faults);
        } else {
            find_faults(held, known->object, here, faults);
        }
    }
    for (const Property& property : properties)
        if (property.is_required && !value.contains(property.name))
            faults.push_back(fmt::format("{}.{} is missing", at, property.name));
}

std::vector<std::string> faults_of(const Json& log) {
    std::vector<std::string> faults;
    find_faults(log, "log", "log", faults);
    if (!faults.empty()) return faults;
    if (log.at("version") != "2.1.0") faults.emplace_back("version");
    for (const Json& run : log.at("runs"))
        for (const Json& result : run.at("results")) {
            const Json& rules = run.at("tool").at("driver").at("rules");
            if (rules.at(result.at("ruleIndex").get<std::size_t>()).at("id") != result.at("ruleId"))
                faults.emplace_back("ruleIndex");
            if (result.at("level") != "error" && result.at("level") != "warning" &&
                result.at("level") != "note")
                faults.emplace_back("level");
        }
    return faults;
}

struct Answer {
    int status = 0;
    std::string messages;
};

/// Runs the command of a case with a gobo that is given one more option.
Answer answer_of(const CaseFile& file, const std::string& format) {
    std::string folder = "/tmp/gobo_messages_XXXXXX";
    folder = ::mkdtemp(folder.data());
    DiskFileSystem disk;
    for (const auto& [name, text] : file.files) EXPECT_TRUE(disk.write(folder + "/" + name, text));
    const std::string gobo = folder + "/bin/gobo";
    EXPECT_TRUE(disk.write(
        gobo, fmt::format("#!/bin/sh\nexec {}/gobo \"$@\" --diagnostics {}\n", GOBO_PROGRAM_FOLDER, format)));
    std::filesystem::permissions(gobo, std::filesystem::perms::owner_all);
    const std::string line = fmt::format(
        "cd {0} && export PATH={0}/bin:$PATH LC_ALL=C && ( {1}\n ) 2>&1 >out", folder, file.command);
    FILE* pipe = ::popen(line.c_str(), "r");
    Answer answer;
    std::array<char, 4096> buffer;
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
        answer.messages.append(buffer.data(), count);
    const int status = ::pclose(pipe);
    answer.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    std::filesystem::remove_all(folder);
    return answer;
}

/// Those that call gobo once, with its standard error left alone.
std::vector<std::string> case_names() {
    std::vector<std::string> names;
    const DiskFileSystem disk;
    for (const std::string& path : disk.files_below(cases_folder)) {
        const std::string command = read_case(disk.read(cases_folder + "/" + path).value()).command;
        const bool is_plain =
            command.starts_with("gobo ") &&
            std::min(command.find_first_of(";|&<>\n("), command.size()) + 1 >= command.size();
        if (is_plain && command.find("-- ") == std::string::npos)
            names.push_back(path.substr(0, path.find('.')));
    }
    return names;
}

/// By the case and the format.
class MachineMessages : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(MachineMessages, HoldWhatReadersAreTold) {
    const auto& [name, format] = GetParam();
    const DiskFileSystem disk;
    const CaseFile file = read_case(disk.read(cases_folder + "/" + name + ".txt").value());
    std::map<std::string, int> told;  // by severity
    for (const std::string& line : split(file.answer, '\n'))
        for (const char* severity : {"error", "warning", "note"})
            if (line.find(fmt::format(": {}: ", severity)) != std::string::npos) ++told[severity];
    const Answer answer = answer_of(file, format);
    EXPECT_EQ(fmt::format("exit {}", answer.status), file.answer.substr(0, 6)) << answer.messages;
    const Json document = Json::parse(answer.messages, nullptr, false);
    ASSERT_FALSE(document.is_discarded()) << answer.messages;
    const bool is_sarif = format == "sarif";
    if (is_sarif) {
        EXPECT_THAT(faults_of(document), testing::IsEmpty()) << answer.messages;
    }
    const Json& list = is_sarif ? document.at("runs").at(0).at("results") : document.at("diagnostics");
    std::map<std::string, int> found;
    for (const Json& one : list) ++found[one.at(is_sarif ? "level" : "severity").get<std::string>()];
    EXPECT_EQ(found, told) << answer.messages;
}

constexpr auto name_of_row = [](const auto& row) {
    return std::get<0>(row.param) + "_" + std::get<1>(row.param);
};
INSTANTIATE_TEST_SUITE_P(Cases, MachineMessages,
                         testing::Combine(testing::ValuesIn(case_names()), testing::Values("json", "sarif")),
                         name_of_row);

TEST(MachineMessages, AreOfManyCases) {
    EXPECT_GE(case_names().size(), 100U);
}

TEST(MachineMessages, NameOneKeyAndHowManyMore) {
    const CaseFile file{"",
                        "gobo check f.toml --all",
                        {{"f.toml",
                          "name=\"f\"\nvertex=\"f.vert\"\nfragment=\"f.frag\"\n[features.lamp]\nconstant="
                          "\"LAMPS\"\ncount=[0,3]\n"},
                         {"f.vert", "#version 450\nvoid main() { gl_Position = vec4(0.0); }\n"},
                         {"f.frag", "#version 450\nout vec4 c;\nvoid main() { c = vec4(lamps); }\n"}},
                        ""};
    const Json found = Json::parse(answer_of(file, "json").messages)["diagnostics"];
    ASSERT_EQ(found.size(), 1U) << found;
    EXPECT_EQ(found[0]["key"], "default");
    EXPECT_EQ(found[0]["more_keys"], 3);
    const Json log = Json::parse(answer_of(file, "sarif").messages);
    EXPECT_THAT(faults_of(log), testing::IsEmpty());
    const Json& result = log["runs"][0]["results"][0];
    EXPECT_EQ(result["properties"]["key"], "default");
    EXPECT_EQ(result["properties"]["more_keys"], 3);
    EXPECT_THAT(result["message"]["text"], testing::HasSubstr("[default, and 3 more keys]"));
}

TEST(MachineMessages, TellPlacesInCharacters) {
    // Bytes would be 23: four of the letters take two.
    const CaseFile file{
        "",
        "gobo list 'a b/f.toml'",
        {{"a b/f.toml",
          "name=\"\u00e4\u00e4\u00e4\u00e4\"\nnome={a=1, \"\u00e4\u00e4\u00e4\u00e4\"=2, b=}\n"}},
        ""};
    const Json log = Json::parse(answer_of(file, "sarif").messages);
    EXPECT_THAT(faults_of(log), testing::IsEmpty());
    const Json& place = log["runs"][0]["results"][0]["locations"][0]["physicalLocation"];
    EXPECT_EQ(place["artifactLocation"]["uri"], "a%20b/f.toml");
    EXPECT_EQ(place["region"]["startLine"], 2);
    EXPECT_EQ(place["region"]["startColumn"], 24) << log.dump(2);
    Json wrong = log;
    wrong["runs"][0]["results"][0].erase("message");
    wrong["runs"][0]["more"] = 1;
    EXPECT_THAT(faults_of(wrong), testing::ElementsAre("log.runs.more is not in the schema",
                                                       "log.runs.results.message is missing"))
        << "so that the check finds something";
}

}  // namespace
}  // namespace gobo
