#include "gobo/shard_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/csv.hpp"
#include "core/digest.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

constexpr std::string_view kBrace = "{\n";
constexpr std::string_view kNumber = " \"shard\": ";
constexpr std::string_view kRun = " \"run\": ";
constexpr std::string_view kChecksum = " \"checksum\": ";
constexpr std::string_view kTableNumber = "shard ";

std::string checksum_of(const Shard& shard) {
    return hex(digest_of(fmt::format("{}\n{}\n{}", shard.number, shard.run, shard.text)));
}

/// What stands between `name` and ",\n" at the front of `text`, which both are taken from; empty where they
/// do not.
std::string taken_member(std::string_view& text, std::string_view name) {
    const std::size_t end = text.find(",\n");
    if (!text.starts_with(name) || end == std::string_view::npos) return {};
    std::string value(text.substr(name.size(), end - name.size()));
    text.remove_prefix(end + 2);
    return value;
}

std::string without_quotes(const std::string& text) {
    return text.size() < 2 ? text : text.substr(1, text.size() - 2);
}

}  // namespace

std::string text_of_shard(std::string results, const std::string& number, const std::string& run) {
    if (number.empty()) return results;
    const Shard shard{{}, number, run, std::move(results)};
    const std::string checksum = checksum_of(shard);
    if (!shard.text.starts_with(kBrace))
        return shard.text + csv_text({{std::string(kTableNumber) + number, run, checksum}, {}});
    return fmt::format("{}{}\"{}\",\n{}{},\n{}\"{}\",\n{}", kBrace, kNumber, number, kRun, run, kChecksum,
                       checksum, std::string_view(shard.text).substr(kBrace.size()));
}

Result<Shard> read_shard(const std::string& path, std::string_view text) {
    Shard shard{path, {}, {}, {}};
    std::string checksum;
    if (text.starts_with(kBrace)) {
        std::string_view rest = text.substr(kBrace.size());
        shard.number = without_quotes(taken_member(rest, kNumber));
        shard.run = taken_member(rest, kRun);
        checksum = without_quotes(taken_member(rest, kChecksum));
        shard.text = fmt::format("{}{}", kBrace, rest);
    } else if (text.ends_with('\n')) {
        const std::size_t last = text.rfind('\n', text.size() - 2) + 1;  // 0 where it is the only line
        const std::vector<std::string> cells = read_csv(text.substr(last)).columns;
        if (cells.size() == 3 && cells[0].starts_with(kTableNumber)) {
            shard.number = cells[0].substr(kTableNumber.size());
            shard.run = cells[1];
            checksum = cells[2];
        }
        shard.text = text.substr(0, last);
    }
    if (shard.number.empty())
        return fail(Place{path}, {},
                    "does not say which shard it is: it is not whole, or not of a run with --shard",
                    "name what gobo test --figures, gobo cost --csv or gobo cost --json wrote with --shard");
    if (checksum != checksum_of(shard))
        return fail(Place{path}, {}, "is not as it was written: its checksum is that of another text",
                    "run its shard again");
    return shard;
}

}  // namespace gobo
