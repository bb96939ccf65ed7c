// Mutation run: can `gobo test` fail? Each mutant of each piece must be caught on a few permutations that use
// the piece, or stand in docs/mutants.md with the reason why it cannot matter.
#include <algorithm>
#include <cstdio>
#include <map>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "../verify/lit_library.hpp"
#include "core/file_system.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "family/key.hpp"
#include "family/selection.hpp"
#include "lab/verify/on_mesh.hpp"
#include "mutants.hpp"

namespace gobo {
namespace {

constexpr std::size_t kKeysPerMutant = 24;

/// A line of the table: piece and mutated line.
using Row = std::pair<std::string, std::string>;

/// "| `fog/linear.glsl` | `mutated line` | reason |"
std::set<Row> excused_mutants() {
    const DiskFileSystem disk;
    const std::string text = disk.read(std::string(GOBO_SOURCE_DIR) + "/docs/mutants.md").value();
    std::set<Row> rows;
    for (const std::string& line : split(text, '\n')) {
        if (!line.starts_with("| `")) continue;
        std::vector<std::string> quoted;
        std::size_t from = line.find('`');
        while (from != std::string::npos && quoted.size() < 2) {
            const std::size_t end = line.find('`', from + 1);
            quoted.push_back(line.substr(from + 1, end - from - 1));
            from = line.find('`', end + 1);
        }
        if (quoted.size() == 2) rows.emplace(quoted[0], quoted[1]);
    }
    return rows;
}

int lights(const Family& family, const Key& key) {
    int count = 0;
    for (const std::string_view name : {"directional", "point", "spot"})
        count += key[static_cast<std::size_t>(*family.index_of(name))];
    return count;
}

/// A cover by threes of up to three lights, since among many an error drowns, and one by twos of any number;
/// excluded values too, whose pieces are shipped. Few lights first.
std::vector<Key> keys_to_try(const Family& family) {
    Selection selection;
    selection.excluded = true;
    selection.cover = 2;
    std::vector<Key> keys = select(family, selection, "450").value();
    selection.cover = 3;
    selection.where = "directional + point + spot <= 3";
    const std::vector<Key> dim = select(family, selection, "450").value();
    keys.insert(keys.end(), dim.begin(), dim.end());
    std::stable_sort(keys.begin(), keys.end(),
                     [&](const Key& a, const Key& b) { return lights(family, a) < lights(family, b); });
    return keys;
}

/// The keys that use each piece.
std::map<std::string, std::vector<Key>> keys_by_piece(const Family& family) {
    const std::vector<Key> keys = keys_to_try(family);
    const Composition composition = compose_lit(family, keys, {}).value();
    std::map<std::string, std::vector<Key>> result;
    for (const Permutation& permutation : composition.permutations) {
        std::set<std::string> names;
        for (const int stage :
             {permutation.stages[StageKind::vertex], permutation.stages[StageKind::fragment]})
            for (const int piece : composition.stages[static_cast<std::size_t>(stage)].pieces)
                names.insert(composition.pieces[static_cast<std::size_t>(piece)].name);
        for (const std::string& name : names) result[name].push_back(permutation.key);
    }
    return result;
}

/// At most kKeysPerMutant of them, spread over the whole list, the last among them.
std::vector<Key> some_of(const std::vector<Key>& keys) {
    const std::size_t count = std::min(kKeysPerMutant, keys.size());
    std::vector<Key> result;
    for (std::size_t i = 0; i < count; ++i)
        result.push_back(keys[count == 1 ? 0 : i * (keys.size() - 1) / (count - 1)]);
    return result;
}

enum class Fate { refused, caught, survived };

/// Does verification of one permutation find anything amiss?
bool is_caught(const verify::PermutationReport& report) {
    const auto has_failed = [](const verify::RelationReport& relation) { return relation.failed > 0; };
    return report.failed_points > 0 || !report.diagnostics.empty() ||
           std::any_of(report.relations.begin(), report.relations.end(), has_failed);
}

/// What becomes of a mutant, with the first permutation that shows it; glslang may refuse it, which proves
/// nothing.
Fate fate_of(const Family& family, const std::vector<Key>& keys, const Mutant& mutant,
             const verify::VerifyOptions& options) {
    for (const Key& key : keys) {
        const auto report = verify_lit(family, {key}, {{mutant.piece, mutant.text}}, options);
        if (!report) return Fate::refused;
        if (is_caught(report->permutations.front())) return Fate::caught;
    }
    return Fate::survived;
}

/// Points first, since they are the quickest; then all that `gobo test` does.
Fate fate_of(const Family& family, const std::vector<Key>& keys, const Mutant& mutant,
             const std::vector<Mesh>& meshes) {
    verify::VerifyOptions options;
    const Fate fate = fate_of(family, keys, mutant, options);
    if (fate != Fate::survived) return fate;
    options.meshes = meshes;
    return fate_of(family, keys, mutant, options);
}

/// Counts of a run, and what is wrong with it.
struct Tally {
    std::map<Fate, int> count;
    std::set<Row> survivors;
    int unexcused = 0;
};

void count(const Mutant& mutant, Fate fate, const std::set<Row>& excused, Tally& tally) {
    ++tally.count[fate];
    if (fate != Fate::survived) return;
    const Row row{mutant.piece, mutant.mutated_line};
    tally.survivors.insert(row);
    if (excused.contains(row)) return;
    ++tally.unexcused;
    fmt::print("survived: shader_lib/{}:{}: {}: `{}`\n", mutant.piece, mutant.line, mutant.change,
               mutant.mutated_line);
    std::fflush(stdout);  // a run takes minutes, and may be broken off
}

/// The excused mutants of these pieces that do not survive.
int print_stale(const std::set<Row>& excused, const std::set<Row>& survivors, const std::string& only) {
    int stale = 0;
    for (const auto& [piece, line] : excused) {
        if (survivors.contains({piece, line}) || !piece.starts_with(only)) continue;
        fmt::print("docs/mutants.md excuses a mutant that does not survive: {}: `{}`\n", piece, line);
        ++stale;
    }
    return stale;
}

int run(const std::string& only) {
    const DiskFileSystem disk;
    const std::string source = GOBO_SOURCE_DIR;
    const Family family = lit_family();
    const std::set<Row> excused = excused_mutants();
    const auto keys = keys_by_piece(family);
    const auto meshes = verify::test_meshes(read_obj(disk, source + "/data/meshes/teapot.obj").value());
    const int jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    Tally tally;
    for (const std::string& piece : piece_paths()) {
        const auto users = keys.find(shipped_pieces().find(piece).value()->name);
        if (users == keys.end() || !piece.starts_with(only)) continue;
        const std::vector<Mutant> mutants = mutants_of(piece, piece_text(piece));
        const std::vector<Key> some = some_of(users->second);
        std::vector<Fate> fates(mutants.size());
        parallel_for(jobs, mutants.size(),
                     [&](std::size_t i) { fates[i] = fate_of(family, some, mutants[i], meshes); });
        for (std::size_t i = 0; i < mutants.size(); ++i) count(mutants[i], fates[i], excused, tally);
    }
    const int stale = print_stale(excused, tally.survivors, only);
    fmt::print("{} mutants: {} caught, {} excused, {} survived; {} more are no valid GLSL\n",
               tally.count[Fate::caught] + tally.count[Fate::survived], tally.count[Fate::caught],
               tally.count[Fate::survived] - tally.unexcused, tally.unexcused, tally.count[Fate::refused]);
    return tally.unexcused > 0 || stale > 0 ? 1 : 0;
}

}  // namespace
}  // namespace gobo

/// With an argument, only the pieces whose path starts with it.
int main(int argc, char** argv) {
    return gobo::run(argc > 1 ? argv[1] : "");
}
