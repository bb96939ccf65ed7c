// gobo merge: what the shards of a run wrote, as the run without shards writes it.
#include <algorithm>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/csv.hpp"
#include "core/text.hpp"
#include "gobo/commands.hpp"
#include "gobo/shard_run.hpp"

namespace gobo {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kInOrder = "name every shard once, in order";
constexpr const char* kRunAgain = "run its shard again, and name every shard once, in order";

struct Shard {
    std::string path;
    std::string text;
    std::string number = {};  ///< "1/2"; empty where it states none
    std::string run = {};     ///< run_of_shards()
};

/// Shards take turns: the first key is the first one's, the next the second one's. `groups` are each shard's
/// keys with what they have, `key_of` tells the key. Their order as it was; an error where a shard lacks a
/// key or has another one's.
template <class Group>
Result<std::vector<Group>> in_turn(std::vector<std::vector<Group>> groups, const std::vector<Shard>& shards,
                                   const std::function<std::string(const Group&)>& key_of) {
    std::map<std::string, std::size_t> owners;
    for (std::size_t i = 0; i < groups.size(); ++i)
        for (const Group& group : groups[i])
            if (const auto [owner, is_new] = owners.try_emplace(key_of(group), i); !is_new)
                return fail(Place{shards[i].path}, {},
                            owner->second == i ? fmt::format("holds '{}' twice", owner->first)
                                               : fmt::format("holds '{}', as {} does", owner->first,
                                                             shards[owner->second].path),
                            owner->second == i ? kRunAgain : kInOrder);
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

/// Each is the shard that its place among the files says, of the same run as the first; where they state it.
Result<void> check_shards(const std::vector<Shard>& shards) {
    if (const std::string missing = missing_shard(shards); !missing.empty())
        return fail(Place{shards.front().path}, {},
                    fmt::format("is shard {}, and {} is missing", shards.front().number, missing), kInOrder);
    for (std::size_t i = 0; i < shards.size(); ++i) {
        const Shard& shard = shards[i];
        const std::string wanted = fmt::format("{}/{}", i + 1, shards.size());
        if (!shard.number.empty() && shard.number != wanted)
            return fail(Place{shard.path}, {}, fmt::format("is shard {}, not {}", shard.number, wanted),
                        kInOrder);
        if (const std::string difference = difference_of_runs(shards.front().run, shard.run);
            !difference.empty())
            return fail(Place{shard.path}, {},
                        fmt::format("is of another run than {}: of {}", shards.front().path, difference),
                        "merge the shards of one run");
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
        GOBO_TRY(const std::vector<Json> rows, in_turn<Json>(std::move(groups), shards, [](const Json& row) {
                     return row["key"].is_string() ? row["key"].get<std::string>() : row["key"].dump();
                 }));
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
                        fmt::format("has another '{}' than {}", name, shards.front().path),
                        "merge the shards of one run");
    return first;
}

/// The blanks at the beginning of a document's second line.
int indentation_of(std::string_view text) {
    const std::string_view line = line_of(text, 2);
    return static_cast<int>(std::min(line.find_first_not_of(' '), line.size()));
}

Result<std::string> merged_json(std::vector<Shard> shards) {
    std::vector<Json> documents;
    for (Shard& shard : shards) {
        documents.push_back(Json::parse(shard.text, nullptr, false));
        if (documents.back().is_discarded() || !documents.back().is_object())
            return fail(Place{shard.path}, {}, "is not whole", kRunAgain);
    }
    for (std::size_t i = 0; i < documents.size(); ++i)
        for (const auto& [name, text] :
             {std::pair("shard", &shards[i].number), std::pair("run", &shards[i].run)}) {
            const Json stated = documents[i].value(name, Json());
            if (!stated.is_null()) *text = stated.is_string() ? stated.get<std::string>() : stated.dump();
            documents[i].erase(name);
        }
    GOBO_TRY_DO(check_shards(shards));
    std::vector<const Json*> values;
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

/// What the rows say in a column, which is taken out; empty where there is none.
std::string taken_column(CsvTable& table, std::string_view name) {
    const auto column = table.column(name);
    if (!column) return {};
    const auto at = static_cast<std::ptrdiff_t>(*column);
    std::string text = table.rows.empty() ? "" : table.rows.front()[*column];
    table.columns.erase(table.columns.begin() + at);
    for (auto& row : table.rows) row.erase(row.begin() + at);
    return text;
}

/// Each shard that has keys has the parts of the first, in its order: figures of two chips are no figures of
/// one run.
Result<void> check_parts(const std::vector<std::vector<Rows>>& parts, const std::vector<Shard>& shards,
                         const CsvTable& table) {
    std::vector<std::vector<std::string>> names;  // of each shard
    for (const auto& own : parts)
        for (auto& list = names.emplace_back(); const Rows& part : own) {
            std::string& name = list.emplace_back("figures");
            for (std::size_t i = 0; i < table.column("key").value(); ++i)
                name += fmt::format("{} {} '{}'", i > 0 ? "," : " of", table.columns[i], part.front()[i]);
        }
    for (std::size_t i = 1; i < names.size(); ++i) {
        if (names[i].empty()) continue;
        for (const auto& [one, other] : {std::pair(i, std::size_t{0}), std::pair(std::size_t{0}, i)})
            for (const std::string& name : names[one])
                if (std::ranges::find(names[other], name) == names[other].end())
                    return fail(Place{shards[one].path}, {},
                                fmt::format("has {}, and {} has none", name, shards[other].path),
                                "merge the shards of one run, all for the same chips");
        if (names[i] != names[0])
            return fail(Place{shards[i].path}, {},
                        fmt::format("has its rows in another order than {}", shards[0].path), kRunAgain);
    }
    return {};
}

/// What stands before the column `key` parts the table: each part is put together by itself.
Result<std::string> merged_csv(std::vector<Shard> shards) {
    CsvTable whole;
    std::vector<std::vector<Rows>> parts;  // of each shard
    for (Shard& shard : shards) {
        CsvTable table = read_csv(shard.text);
        shard.number = taken_column(table, "shard");
        shard.run = taken_column(table, "run");
        if (table.rows.empty()) shard.run = shards.front().run;  // no row could tell
        const auto key = table.column("key");
        if (!key || (!whole.columns.empty() && table.columns != whole.columns))
            return fail(Place{shard.path}, {},
                        key ? fmt::format("has other columns than {}", shards.front().path)
                            : "has no keys to put together",
                        "name what gobo test --figures, gobo cost --csv or gobo cost --json wrote");
        whole.columns = table.columns;
        parts.push_back(groups_of(table.rows, *key));
    }
    GOBO_TRY_DO(check_shards(shards));
    GOBO_TRY_DO(check_parts(parts, shards, whole));
    for (auto& own : parts) own.resize(parts.front().size());
    const std::size_t key = whole.column("key").value();
    for (std::size_t part = 0; part < parts.front().size(); ++part) {
        std::vector<std::vector<Rows>> groups;
        for (const auto& own : parts) groups.push_back(groups_of(own[part], key + 1));
        GOBO_TRY(
            const std::vector<Rows> merged_rows,
            in_turn<Rows>(std::move(groups), shards, [&](const Rows& rows) { return rows.front()[key]; }));
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
        GOBO_TRY(std::string text, world.disk.read(path));
        shards.push_back({path, std::move(text)});
    }
    const bool is_json = shards.front().text.starts_with('{');
    GOBO_TRY(std::string text, is_json ? merged_json(shards) : merged_csv(shards));
    if (options.output.empty()) return Outcome{std::move(text)};
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
