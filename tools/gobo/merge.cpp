// gobo merge: what the shards of a run wrote, as the run without shards writes it.
#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/csv.hpp"
#include "core/text.hpp"
#include "gobo/commands.hpp"
#include "gobo/shard_run.hpp"
#include "gobo/shard_text.hpp"

namespace gobo {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kInOrder = "name every shard once, in order";
constexpr const char* kSameRun = "merge the shards of one run";
constexpr const char* kRunAgain = "run its shard again, and name every shard once, in order";

/// Shards take turns: the first key is the first one's, the next the second one's. `groups` are each shard's
/// keys with what they have. Their order as it was; an error where a shard lacks a key.
template <class Group>
Result<std::vector<Group>> in_turn(std::vector<std::vector<Group>> groups, const std::vector<Shard>& shards) {
    std::size_t count = 0;
    for (const auto& own : groups) count += own.size();
    for (std::size_t i = 0; i < groups.size(); ++i) {
        const std::size_t wanted = (count + groups.size() - 1 - i) / groups.size();
        if (groups[i].size() != wanted)
            return fail(Place{shards[i].path}, {},
                        fmt::format("holds {} keys of {}, where shard {}/{} has {}", groups[i].size(), count,
                                    i + 1, groups.size(), wanted),
                        kRunAgain);
    }
    std::vector<Group> merged;
    for (std::size_t i = 0; i < count; ++i)
        merged.push_back(std::move(groups[i % groups.size()][i / groups.size()]));
    return merged;
}

bool is_list_of_keys(const Json& value) {
    return value.is_array() &&
           std::ranges::all_of(value, [](const Json& row) { return row.is_object() && row.contains("key"); });
}

/// "2/3", the first shard that none of too few files is; empty where there is none.
std::string missing_shard(const std::vector<Shard>& shards) {
    const std::size_t count =
        pair_from(shards.front().number, '/').value_or(std::pair<std::size_t, std::size_t>()).second;
    for (std::size_t number = 1; shards.size() < count && number <= count; ++number) {
        std::string wanted = fmt::format("{}/{}", number, count);
        if (std::ranges::find(shards, wanted, &Shard::number) == shards.end()) return wanted;
    }
    return {};
}

/// Each is the shard that its place among the files says, of the same run as the first.
Result<void> check_shards(const std::vector<Shard>& shards) {
    if (const std::string missing = missing_shard(shards); !missing.empty())
        return fail(Place{shards.front().path}, {},
                    fmt::format("is shard {}, and {} is missing", shards.front().number, missing), kInOrder);
    for (std::size_t i = 0; i < shards.size(); ++i) {
        const Shard& shard = shards[i];
        const std::string wanted = fmt::format("{}/{}", i + 1, shards.size());
        if (shard.number != wanted)
            return fail(Place{shard.path}, {}, fmt::format("is shard {}, not {}", shard.number, wanted),
                        kInOrder);
        if (const std::string difference = difference_of_runs(shards.front().run, shard.run);
            !difference.empty())
            return fail(Place{shard.path}, {},
                        fmt::format("is of another run than {}: of {}", shards.front().path, difference),
                        kSameRun);
    }
    return {};
}

/// Lists of keys are put together, lists of other objects one by one; all else must be the same.
Result<Json> merged(const std::vector<const Json*>& values, const std::vector<Shard>& shards,
                    const std::string& name) {
    const Json& first = *values.front();
    const auto all_are = [&](auto is_so) {
        return std::ranges::all_of(values, [&](const Json* value) { return is_so(*value); });
    };
    if (all_are(is_list_of_keys)) {
        std::vector<std::vector<Json>> groups;
        for (const Json* value : values) groups.emplace_back(value->begin(), value->end());
        GOBO_TRY(const std::vector<Json> rows, in_turn(std::move(groups), shards));
        return Json(rows);
    }
    const bool has_parts = all_are(
        [&](const Json& value) { return value.type() == first.type() && value.size() == first.size(); });
    if (has_parts && (first.is_object() || first.is_array())) {
        Json whole = first;
        std::ptrdiff_t index = 0;
        for (auto at = first.begin(); at != first.end(); ++at, ++index) {
            std::vector<const Json*> parts;
            for (const Json* value : values) {
                if (first.is_object() && !value->contains(at.key())) break;
                parts.push_back(first.is_object() ? &value->at(at.key()) : &*(value->begin() + index));
            }
            if (parts.size() != values.size()) break;
            GOBO_TRY(Json part, merged(parts, shards, first.is_object() ? at.key() : name));
            if (first.is_object())
                whole[at.key()] = std::move(part);
            else
                whole[static_cast<std::size_t>(index)] = std::move(part);
        }
        return whole;
    }
    for (std::size_t i = 1; i < values.size(); ++i)
        if (*values[i] != first)
            return fail(Place{shards[i].path}, {},
                        fmt::format("has another '{}' than {}", name, shards.front().path), kSameRun);
    return first;
}

/// The blanks at the beginning of a document's second line.
int indentation_of(std::string_view text) {
    const std::string_view line = line_of(text, 2);
    return static_cast<int>(std::min(line.find_first_not_of(' '), line.size()));
}

Result<std::string> merged_json(const std::vector<Shard>& shards) {
    std::vector<Json> documents;
    std::vector<const Json*> values;
    for (const Shard& shard : shards) documents.push_back(Json::parse(shard.text, nullptr, false));
    for (const Json& document : documents) values.push_back(&document);
    GOBO_TRY(const Json whole, merged(values, shards, "document"));
    return whole.dump(indentation_of(shards.front().text)) + "\n";
}

/// Rows that follow one another and have the same cells up to a column.
using Rows = std::vector<std::vector<std::string>>;
std::vector<Rows> groups_of(const Rows& rows, std::size_t columns) {
    std::vector<Rows> groups;
    for (const auto& row : rows) {
        const bool goes_on =
            !groups.empty() && std::equal(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(columns),
                                          groups.back().front().begin());
        if (!goes_on) groups.emplace_back();
        groups.back().push_back(row);
    }
    return groups;
}

/// Each shard that has keys has the parts of the first: figures of two drivers are no figures of one run.
Result<void> check_parts(const std::vector<std::vector<Rows>>& parts, const std::vector<Shard>& shards,
                         const CsvTable& table, std::size_t key) {
    std::vector<std::vector<std::string>> names;  // of each shard
    for (const auto& own : parts)
        for (auto& list = names.emplace_back(); const Rows& part : own) {
            std::string& name = list.emplace_back("figures");
            for (std::size_t i = 0; i < key; ++i)
                name += fmt::format("{} {} '{}'", i > 0 ? "," : " of", table.columns[i], part.front()[i]);
        }
    for (std::size_t i = 1; i < names.size(); ++i) {
        if (names[i].empty()) continue;
        for (const auto& [one, other] : {std::pair(i, std::size_t{0}), std::pair(std::size_t{0}, i)})
            for (const std::string& name : names[one])
                if (std::ranges::find(names[other], name) == names[other].end())
                    return fail(Place{shards[one].path}, {},
                                fmt::format("has {}, and {} has none", name, shards[other].path),
                                "merge the shards of one run, all by the same driver");
    }
    return {};
}

/// What stands before the column `key` parts the table: each part is put together by itself.
Result<std::string> merged_csv(const std::vector<Shard>& shards) {
    CsvTable whole = read_csv(shards.front().text);
    const std::size_t key = whole.column("key").value_or(0);
    whole.rows.clear();
    std::vector<std::vector<Rows>> parts;  // of each shard
    for (const Shard& shard : shards) {
        const CsvTable table = read_csv(shard.text);
        if (table.columns != whole.columns)
            return fail(Place{shard.path}, {}, fmt::format("has other columns than {}", shards.front().path),
                        kSameRun);
        parts.push_back(groups_of(table.rows, key));
    }
    GOBO_TRY_DO(check_parts(parts, shards, whole, key));
    for (auto& own : parts) own.resize(parts.front().size());
    for (std::size_t part = 0; part < parts.front().size(); ++part) {
        std::vector<std::vector<Rows>> groups;
        for (const auto& own : parts) groups.push_back(groups_of(own[part], key + 1));
        GOBO_TRY(const std::vector<Rows> merged_rows, in_turn(std::move(groups), shards));
        for (const Rows& rows : merged_rows) whole.rows.insert(whole.rows.end(), rows.begin(), rows.end());
    }
    return csv_text(whole);
}

struct MergeOptions {
    std::vector<std::string> paths;
    std::string output;
};

Result<Outcome> run(const MergeOptions& options, const World& world) {
    std::vector<Shard> shards;
    for (const std::string& path : options.paths) {
        GOBO_TRY(const std::string text, world.disk.read(path));
        GOBO_TRY(Shard shard, read_shard(path, text));
        shards.push_back(std::move(shard));
    }
    GOBO_TRY_DO(check_shards(shards));
    const bool is_json = shards.front().text.starts_with('{');
    GOBO_TRY(std::string text, is_json ? merged_json(shards) : merged_csv(shards));
    if (options.output.empty() || options.output == "-") return Outcome{std::move(text)};
    Outcome outcome{{}, {}, fmt::format("{}: {} shards", options.output, shards.size())};
    outcome.files.push_back({options.output, std::move(text)});
    return outcome;
}

}  // namespace

Command merge_command() {
    const auto options = std::make_shared<MergeOptions>();
    return {{"merge", "Put together what the shards of a run wrote"},
            {{"FILES", "", "What each shard wrote, the first one's first", &options->paths, kRequired},
             {"-o,--output", "FILE", "Write it there instead of printing it", &options->output}},
            {},
            "  gobo test lit --cover 3 --shard 1/2 --figures 1.json\n"
            "  gobo test lit --cover 3 --shard 2/2 --figures 2.json\n"
            "  gobo merge 1.json 2.json -o figures.json",
            [options](const World& world) { return run(*options, world); },
            "The result has the same bytes as that of a run without --shard. Of gobo test it takes what "
            "--figures "
            "wrote, of gobo cost what --csv or --json printed."};
}

}  // namespace gobo
