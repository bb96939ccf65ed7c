#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "lab/prove/prove.hpp"
#include "lab/sanitize/input_space.hpp"

namespace gobo::prove {
namespace {

constexpr std::string_view kWords[] = {"impossible", "undecided", "possible"};

std::string_view word(Status status) {
    return kWords[static_cast<std::size_t>(status)];
}

std::string number(double value) {
    return fmt::format("{:.8g}", value);
}

std::string range_text(const Range& range) {
    if (range.has_no_number()) return range.nan ? "NaN" : "nothing";
    std::string text = fmt::format("[{}, {}]", number(range.low), number(range.high));
    if (range.nan) text += " or NaN";
    return text;
}

/// Of operations, or of one rule at operations.
struct Count {
    std::size_t all = 0;
    std::size_t ignoring_tiny = 0;
    std::array<std::size_t, 3> by_status{};

    void add(Status status, bool ignores_tiny) {
        ++all;
        ++by_status[static_cast<std::size_t>(status)];
        if (status == Status::impossible && ignores_tiny) ++ignoring_tiny;
    }
    void add(const SourceOperation& operation, bool own_only) {
        Status worst = Status::impossible;
        bool ignores_tiny = false;
        for (const ProvenRule& rule : operation.rules) {
            if (own_only && rule.is_of_results) continue;
            worst = std::max(worst, rule.status);
            ignores_tiny = ignores_tiny || rule.ignores_tiny;
        }
        add(worst, ignores_tiny);
    }
};

/// An infinity or NaN of an operation that has a closer reason, which is not excluded either.
bool follows(const SourceOperation& operation, const ProvenRule& rule) {
    return rule.is_of_results && std::ranges::any_of(operation.rules, [](const ProvenRule& other) {
               return !other.is_of_results && other.status != Status::impossible;
           });
}

constexpr std::string_view kColumns = "{:<66} {:>10} {:>10} {:>9} {:>8} {:>8}\n";

std::string count_line(const std::string& name, const Count& count) {
    const std::string share = count.all == 0
                                  ? "-"
                                  : fmt::format("{:.1f} %", 100.0 * static_cast<double>(count.by_status[0]) /
                                                                static_cast<double>(count.all));
    return fmt::format(fmt::runtime(kColumns), name, count.all, count.by_status[0], count.by_status[1],
                       count.by_status[2], share);
}

}  // namespace

std::string proof_text(const ProveReport& report) {
    std::map<std::string, Count> by_rule;
    Count own;
    Count all;
    for (const SourceOperation& operation : report.operations) {
        if (operation.is_constant && operation.is_proven()) continue;
        if (operation.has_own_rule()) own.add(operation, true);
        all.add(operation, false);
        for (const ProvenRule& rule : operation.rules)
            by_rule[rule.message].add(rule.status, rule.ignores_tiny);
    }
    std::string text = fmt::format("{} permutations, {} stages", report.permutations, report.stages);
    if (report.points > 0) text += fmt::format(", held to {} points", report.points);
    text += "\n\n" + fmt::format(fmt::runtime(kColumns), "rule", "operations", "impossible", "undecided",
                                 "possible", "proven");
    for (const auto& [message, count] : by_rule) text += count_line(message, count);
    text += count_line("operations with a rule of their own", own);
    text += count_line("all operations", all);
    if (all.ignoring_tiny > 0)
        text += fmt::format("{} of these are impossible only where inputs nearer to 0 than {} are 0\n",
                            all.ignoring_tiny, sanitize::kSmallest);
    text +=
        "not covered: undefined values, missing returns, unwritten outputs and constants; gobo sanitize "
        "looks for them\n";
    bool is_first = true;
    for (const SourceOperation& operation : report.operations)
        for (const ProvenRule& rule : operation.rules) {
            if (rule.status != Status::undecided || follows(operation, rule)) continue;
            if (is_first) text += "\nundecided\n";
            is_first = false;
            text += fmt::format("{}:{}: {}: {}: {}\n", operation.place.file, operation.place.line,
                                operation.name, rule.message, rule.reason);
            if (!rule.key.empty()) text += fmt::format("    key {}\n", rule.key);
            for (const PartLeft& part : rule.left)
                text += fmt::format("    {} in {}\n", part.name, range_text(part.range));
        }
    text += fmt::format("\n{:<10} {:<28} {:<32} {:<26} {}\n", "stage", "output", "range", "stated", "");
    for (const OutputRange& output : report.outputs) {
        const std::string stated =
            output.is_stated ? fmt::format("[{}, {}]", number(output.stated_low), number(output.stated_high))
                             : "";
        text += fmt::format("{:<10} {:<28} {:<32} {:<26} {}\n", name_of(output.stage), output.name,
                            range_text(output.range), stated,
                            !output.is_stated    ? ""
                            : output.is_within() ? "within"
                                                 : "beyond");
    }
    return text;
}

std::string proof_json(const ProveReport& report) {
    using Json = nlohmann::ordered_json;
    const auto range_json = [](const Range& range) {
        // JSON has no infinity.
        const auto end = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
        return Json{{"low", end(range.low)}, {"high", end(range.high)}, {"nan", range.nan}};
    };
    Json json;
    json["permutations"] = report.permutations;
    json["stages"] = report.stages;
    json["points"] = report.points;
    json["operations"] = Json::array();
    for (const SourceOperation& operation : report.operations) {
        Json rules = Json::array();
        for (const ProvenRule& rule : operation.rules) {
            Json one{{"rule", rule.message}, {"status", word(rule.status)}};
            if (rule.status == Status::undecided) {
                one["reason"] = rule.reason;
                if (!rule.key.empty()) one["key"] = rule.key;
                one["left"] = Json::array();
                for (const PartLeft& part : rule.left) {
                    Json of_part = range_json(part.range);
                    of_part["input"] = part.name;
                    one["left"].push_back(of_part);
                }
            }
            if (rule.status == Status::possible) {
                one["finding"] = sanitize::to_text(rule.example);
                one["machine"] = sanitize::name_of(rule.example.machine);
            }
            if (rule.status == Status::impossible && rule.ignores_tiny)
                one["where_inputs_are_0_or_at_least"] = sanitize::kSmallest;
            rules.push_back(one);
        }
        json["operations"].push_back({{"file", operation.place.file},
                                      {"line", operation.place.line},
                                      {"operation", operation.name},
                                      {"constant", operation.is_constant},
                                      {"stages", operation.stages.size()},
                                      {"rules", rules}});
    }
    json["outputs"] = Json::array();
    for (const OutputRange& output : report.outputs) {
        Json one = range_json(output.range);
        one["stage"] = name_of(output.stage);
        one["output"] = output.name;
        if (output.is_stated) {
            one["stated"] = {output.stated_low, output.stated_high};
            one["within"] = output.is_within();
        }
        json["outputs"].push_back(one);
    }
    return json.dump(1) + "\n";
}

}  // namespace gobo::prove
