// Mutation run: can `gobo test` fail? Each mutant of each piece must be caught on a few permutations that use
// the piece, or stand in docs/mutants.md with the reason why it cannot matter.
#include <algorithm>
#include <map>
#include <set>
#include <thread>

#include <fmt/format.h>

#include "../verify/lit_library.hpp"
#include "common/file_system.hpp"
#include "common/text.hpp"
#include "family/key.hpp"
#include "family/selection.hpp"
#include "mutants.hpp"
#include "verify/test_meshes.hpp"

namespace gobo {
namespace {

constexpr std::size_t kKeysPerMutant = 8;

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

/// The keys of a cover that use each piece: few lights first, since among many an error drowns.
std::map<std::string, std::vector<Key>> keys_by_piece(const Family& family) {
    Selection selection;
    selection.cover = 3;
    selection.retired = true;  // their pieces are shipped, too
    selection.where = "directional + point + spot <= 3";
    std::vector<Key> keys = select(family, selection, "450").value();
    std::stable_sort(keys.begin(), keys.end(),
                     [&](const Key& a, const Key& b) { return lights(family, a) < lights(family, b); });
    const Composition composition = compose_lit(family, keys, {}).value();
    std::map<std::string, std::vector<Key>> result;
    for (const Permutation& permutation : composition.permutations) {
        std::set<std::string> names;
        for (const int stage : {permutation.vertex, permutation.fragment})
            for (const int piece : composition.stages[static_cast<std::size_t>(stage)].pieces)
                names.insert(composition.pieces[static_cast<std::size_t>(piece)].name);
        for (const std::string& name : names) result[name].push_back(permutation.key);
    }
    return result;
}

/// At most kKeysPerMutant of them, spread over the whole list.
std::vector<Key> some_of(const std::vector<Key>& keys) {
    std::vector<Key> result;
    const std::size_t step = std::max<std::size_t>(1, keys.size() / kKeysPerMutant);
    for (std::size_t i = 0; i < keys.size() && result.size() < kKeysPerMutant; i += step)
        result.push_back(keys[i]);
    return result;
}

enum class Fate { refused, caught, survived };

/// What becomes of a mutant: glslang may refuse it, which proves nothing.
Fate fate_of(const Family& family, const std::vector<Key>& keys, const Mutant& mutant,
             const std::vector<Mesh>& meshes) {
    verify::VerifyOptions options;
    options.jobs = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
    options.meshes = meshes;
    const Result<verify::VerifyReport> report =
        verify_lit(family, keys, {{mutant.piece, mutant.text}}, options);
    if (!report) return Fate::refused;
    const auto is_caught = [](const verify::PermutationReport& one) {
        return !one.diagnostics.empty() ||
               std::any_of(one.relations.begin(), one.relations.end(),
                           [](const verify::RelationReport& relation) { return relation.failed > 0; });
    };
    const bool caught = std::any_of(report->permutations.begin(), report->permutations.end(), is_caught);
    return caught || failed_points(*report) > 0 ? Fate::caught : Fate::survived;
}

/// Points first, since they are the quickest; then all that `gobo test` does.
Fate fate_of(const Family& family, const std::vector<Key>& keys, const Mutant& mutant) {
    static const std::vector<Mesh> meshes = verify::test_meshes(
        read_obj(DiskFileSystem(), std::string(GOBO_SOURCE_DIR) + "/data/meshes/teapot.obj").value());
    const Fate fate = fate_of(family, keys, mutant, {});
    return fate == Fate::survived ? fate_of(family, keys, mutant, meshes) : fate;
}

/// Counts of a run, and what is wrong with it.
struct Tally {
    std::map<Fate, int> count;
    std::set<Row> survivors;
    int unexcused = 0;
};

void judge(const Family& family, const std::vector<Key>& keys, const Mutant& mutant,
           const std::set<Row>& excused, Tally& tally) {
    const Fate fate = fate_of(family, keys, mutant);
    ++tally.count[fate];
    if (fate != Fate::survived) return;
    const Row row{mutant.piece, mutant.mutated_line};
    tally.survivors.insert(row);
    if (excused.contains(row)) return;
    ++tally.unexcused;
    fmt::print("survived: shader_lib/{}:{}: {}: `{}`\n", mutant.piece, mutant.line, mutant.change,
               mutant.mutated_line);
}

int run(const std::string& only) {
    const DiskFileSystem disk;
    const Family family = lit_family();
    const std::set<Row> excused = excused_mutants();
    const auto keys = keys_by_piece(family);
    Tally tally;
    std::set<Row> stale;
    for (const std::string& piece : disk.files_below(std::string(GOBO_SOURCE_DIR) + "/shader_lib")) {
        const auto users = keys.find("shader_lib/" + piece);
        if (users == keys.end() || !piece.starts_with(only)) continue;
        for (const Mutant& mutant : mutants_of(piece, piece_text(piece)))
            judge(family, some_of(users->second), mutant, excused, tally);
    }
    for (const Row& row : excused)
        if (!tally.survivors.contains(row) && row.first.starts_with(only)) stale.insert(row);
    for (const auto& [piece, line] : stale)
        fmt::print("docs/mutants.md excuses a mutant that does not survive: {}: `{}`\n", piece, line);
    fmt::print("{} mutants: {} caught, {} excused, {} survived; {} more are no valid GLSL\n",
               tally.count[Fate::caught] + tally.count[Fate::survived], tally.count[Fate::caught],
               tally.count[Fate::survived] - tally.unexcused, tally.unexcused, tally.count[Fate::refused]);
    return tally.unexcused > 0 || !stale.empty() ? 1 : 0;
}

}  // namespace
}  // namespace gobo

/// With an argument, only the pieces whose path starts with it.
int main(int argc, char** argv) {
    return gobo::run(argc > 1 ? argv[1] : "");
}
