#include "sanitize_support.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "compose/compose.hpp"
#include "compose/search_path.hpp"
#include "core/file_system.hpp"
#include "core/text.hpp"
#include "family/constraint.hpp"
#include "lab/evaluate/eval_file.hpp"
#include "lab/evaluate/program.hpp"
#include "lab/sanitize/bounds.hpp"
#include "validate/validate.hpp"

namespace gobo {
namespace {

using OneFile = std::map<std::string, std::string, std::less<>>;

/// A file as a family, with its SPIR-V.
struct Loaded {
    Family family;
    Composition composition;
    Validated validated;
};

/// What states constant_id is Vulkan's.
Dialect dialect_of_text(const std::string& text) {
    return text.find("constant_id") == std::string::npos ? Dialect::own : Dialect::vulkan;
}

Loaded load(const std::string& path, const FileSystem& files) {
    SearchPath search;
    const Result<Family> family = family_of_files({path}, files, search);
    EXPECT_TRUE(family) << path;
    const Result<Composition> composition =
        compose(*family, {Key{}}, search, dialect_of_text(files.read(path).value_or("")));
    EXPECT_TRUE(composition) << path;
    ValidateOptions options;
    options.keep_spirv = true;
    options.debug_information = true;
    Loaded loaded{*family, *composition, validate(*family, *composition, options)};
    for (const Diagnostic& error : loaded.validated.diagnostics)
        if (error.severity == Severity::error) ADD_FAILURE() << to_text(error);
    return loaded;
}

sanitize::SanitizeReport sanitized(const Loaded& loaded, const sanitize::SanitizeOptions& options) {
    sanitize::SanitizeReport report =
        sanitize::sanitize(loaded.family, loaded.composition, loaded.validated, options);
    for (const Diagnostic& error : report.diagnostics) ADD_FAILURE() << to_text(error);
    return report;
}

}  // namespace

Lines marked_lines(const std::string& path) {
    constexpr std::string_view kMark = "// trap: ";
    const Result<std::string> source = DiskFileSystem().read(path);
    EXPECT_TRUE(source) << path;
    Lines lines;
    const auto count = std::count(source->begin(), source->end(), '\n');
    for (int number = 1; number <= count; ++number) {
        const std::string_view line = line_of(*source, number);
        const auto mark = line.find(kMark);
        if (mark == std::string_view::npos) continue;
        for (const std::string& message : split(line.substr(mark + kMark.size()), ';'))
            lines.insert(fmt::format("{}: {}", number, message));
    }
    return lines;
}

Lines found_lines(const sanitize::SanitizeReport& report) {
    Lines lines;
    for (const sanitize::SharedFinding& shared : report.findings)
        lines.insert(fmt::format("{}: {}", shared.finding.place.line, shared.finding.message));
    return lines;
}

Lines consequences(const sanitize::SanitizeReport& report) {
    Lines lines;
    for (const sanitize::SharedFinding& shared : report.findings)
        for (const sanitize::Consequence& one : shared.finding.consequences)
            lines.insert(fmt::format("{}: {}", one.place.line, one.message));
    return lines;
}

std::vector<std::string> shader_files(const std::string& folder) {
    std::vector<std::string> paths;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(GOBO_SOURCE_DIR "/tests/") + folder))
        paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    EXPECT_FALSE(paths.empty()) << folder;
    return paths;
}

std::string file_test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = std::filesystem::path(info.param).filename().string();
    std::replace(name.begin(), name.end(), '.', '_');
    return name;
}

sanitize::SanitizeReport sanitized_file(const std::string& path, const sanitize::SanitizeOptions& options) {
    return sanitized(load(path, DiskFileSystem()), options);
}

sanitize::SanitizeReport sanitized_text(const std::string& name, const std::string& text,
                                        const sanitize::SanitizeOptions& options,
                                        const std::vector<Domain>& domains) {
    Loaded loaded = load(name, MemoryFileSystem(OneFile{{name, text}}));
    loaded.family.domains = domains;
    return sanitized(loaded, options);
}

Lines not_replayed(const std::string& name, const std::string& text, const sanitize::SanitizeReport& report) {
    const Loaded loaded = load(name, MemoryFileSystem(OneFile{{name, text}}));
    const SpirvModule& spirv = loaded.validated.stages.front().spirv;
    const Result<evaluate::Program> program = evaluate::decode(spirv);
    EXPECT_TRUE(program);
    const sanitize::InputSpace space = sanitize::input_space_of(*program, {}, true);
    sanitize::OutputBounds bounds(loaded.family, Key{}, loaded.composition.stages.front().kind, *program,
                                  space, sanitize::depth_promise_of(spirv));
    Lines missing;
    for (const sanitize::SharedFinding& shared : report.findings) {
        const sanitize::Finding& wanted = shared.finding;
        if (wanted.is_of_constants) continue;
        const auto inputs = evaluate::read_eval_inputs(eval_input(wanted, "an input"), "found.toml");
        EXPECT_TRUE(inputs) << to_text(inputs.error().front());
        const auto invocations = evaluate::invocations_of(*inputs, *program);
        EXPECT_TRUE(invocations) << to_text(invocations.error().front());
        const std::string& machine = inputs->machine.text;
        std::vector<sanitize::Interval> allowed = bounds.at(sanitize::point_set(space, wanted.point));
        allowed.resize(allowed.size() / space.pixels * invocations->count);
        const auto again =
            sanitize::find_traps(*program, *invocations,
                                 sanitize::machine_named(machine).value_or(sanitize::Machine::ieee), allowed);
        EXPECT_TRUE(again);
        const bool is_there = std::ranges::any_of(*again, [&](const sanitize::Finding& found) {
            return found.message == wanted.message && found.place == wanted.place &&
                   found.operation == wanted.operation;
        });
        if (!is_there) missing.insert(fmt::format("{}: {}", wanted.place.line, to_text(wanted)));
    }
    return missing;
}

Domain domain(const std::string& name, double low, double high) {
    return plain_domain(name, low, high);
}

namespace {

evaluate::Program decoded(const Loaded& loaded) {
    Result<evaluate::Program> program = evaluate::decode(loaded.validated.stages.front().spirv);
    EXPECT_TRUE(program);
    return std::move(*program);
}

}  // namespace

evaluate::Program program_of(const std::string& name, const std::string& text) {
    return decoded(load(name, MemoryFileSystem(OneFile{{name, text}})));
}

evaluate::Program program_of_file(const std::string& path) {
    return decoded(load(path, DiskFileSystem()));
}

}  // namespace gobo
