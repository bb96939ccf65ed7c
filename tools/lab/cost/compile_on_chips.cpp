#include "lab/cost/compile_on_chips.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/child_processes.hpp"

namespace gobo::cost {
namespace {

using nlohmann::json;

std::string bytes_of(const json& content) {
    const std::vector<std::uint8_t> bytes = json::to_cbor(content);
    return {bytes.begin(), bytes.end()};
}

/// What a child passes on: the driver's name, or why there is none; then the stages, or why there are none.
json told_of(const Result<std::string>& name, const CompiledPipeline* pipeline) {
    if (!name) {
        const Diagnostic& error = name.error().front();
        return {{"lost", error.message}, {"help", error.help}, {"fault", static_cast<int>(error.fault)}};
    }
    json told = {{"driver", *name}};
    if (pipeline == nullptr) return told;
    if (!*pipeline) {
        told["failed"] = pipeline->error();
        return told;
    }
    told["stages"] = json::array();
    for (const CompiledStage& stage : **pipeline)
        told["stages"].push_back({stage.stage, stage.invocations, stage.statistics,
                                  json::binary({stage.assembly.begin(), stage.assembly.end()})});
    return told;
}

CompiledPipeline pipeline_in(const json& told) {
    if (told.contains("failed")) return tl::unexpected(told["failed"].get<std::string>());
    std::vector<CompiledStage> stages;
    for (const json& stage : told["stages"]) {
        const auto& assembly = stage[3].get_binary();
        stages.push_back({stage[0], stage[1], stage[2], {assembly.begin(), assembly.end()}});
    }
    return stages;
}

/// The process that a child asks, and the chip that it is for.
struct Asked {
    std::size_t chip = 0;
    std::unique_ptr<DriverProcess> driver;
};

}  // namespace

std::vector<Result<ChipAnswers>> compile_on_chips(const FileSystem& disk, const std::vector<Chip>& chips,
                                                  const std::vector<Pipeline>& pipelines,
                                                  const CompileOptions& options) {
    const std::string program =
        options.program.empty() ? std::filesystem::read_symlink("/proc/self/exe").string() : options.program;
    // A chip is opened even where there is nothing to compile.
    const std::size_t tasks = std::max<std::size_t>(pipelines.size(), 1);
    std::vector<Result<DriverPlace>> places;
    std::vector<Result<ChipAnswers>> results;
    for (const Chip& chip : chips) {
        places.push_back(find_driver(disk, options.driver, chip.maker));
        results.emplace_back(
            ChipAnswers{"", std::vector<CompiledPipeline>(pipelines.size(), tl::unexpected(std::string()))});
        if (!places.back()) {
            Diagnostics errors = places.back().error();
            errors.front().message.insert(0, fmt::format("{}: ", chip.name));
            results.back() = tl::unexpected(std::move(errors));
        }
    }
    const auto asked = std::make_shared<Asked>();  // each child has its own
    ChildWork work;
    work.work = [&, asked](std::size_t task, Note&) {
        const std::size_t chip = task / tasks;
        if (!places[chip]) return std::string();
        DriverProcess* driver = asked->driver.get();
        // One that cannot be opened is not opened again.
        if (driver == nullptr || asked->chip != chip || (driver->name() && !driver->is_alive())) {
            asked->chip = chip;
            asked->driver =
                std::make_unique<DriverProcess>(*places[chip], chips[chip], program, options.time_limit);
            driver = asked->driver.get();
        }
        if (!driver->name() || pipelines.empty()) return bytes_of(told_of(driver->name(), nullptr));
        const CompiledPipeline compiled = driver->compile(pipelines[task % tasks]);
        return bytes_of(told_of(driver->name(), &compiled));
    };
    work.done = [&](std::size_t task, std::string_view bytes) {
        auto& result = results[task / tasks];
        if (!result) return true;
        const json told = json::from_cbor(bytes.begin(), bytes.end(), true, false);
        if (!told.is_object()) return false;
        if (told.contains("lost")) {
            result = fail(static_cast<Fault>(told["fault"].get<int>()), told["lost"], told["help"]);
            return true;
        }
        result->driver = told["driver"];
        if (!pipelines.empty()) result->pipelines[task % tasks] = pipeline_in(told);
        return true;
    };
    const auto lose = [&](std::size_t task, const char* reason) {
        auto& result = results[task / tasks];
        if (!result) return;
        if (pipelines.empty() || result->driver.empty())
            result = fail(Fault::internal, fmt::format("{}: {}", chips[task / tasks].name, reason));
        else
            result->pipelines[task % tasks] = tl::unexpected(std::string(reason));
    };
    work.died = [&](std::size_t task, int, Death) {
        lose(task, "was not asked: the process that asks it has died");
        return false;
    };
    // Whoever asks only waits: drivers have processes and limits of their own.
    for (const std::size_t task : run_in_children(std::max(options.jobs, 1), chips.size() * tasks, work))
        lose(task, "was not asked: no process can be started");
    return results;
}

}  // namespace gobo::cost
