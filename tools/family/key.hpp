// Keys as text, their canonical form, and messages about them.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "family/family.hpp"

namespace gobo {

/// The key with every feature at its default.
[[nodiscard]] Key default_key(const Family& family);

/// Canonical text: `fog=linear point=3`, sorted by feature name, defaults left out; `default` when all are.
[[nodiscard]] std::string key_text(const Family& family, const Key& key);

/// Reads key text in any order; not yet canonical. Unknown features and values suggest the nearest; a feature
/// named twice is refused. `place` is where the text stands (an empty file: the command line, Fault::usage).
[[nodiscard]] Result<Key> parse_key(const Family& family, std::string_view text, const Place& place = {});

/// The key with everything that cannot matter at its default: the rules' defaults applied, in order, until
/// none changes anything. It ends, since each change takes one more feature to its default.
[[nodiscard]] Key canonical(const Family& family, Key key, std::string_view dialect);

/// The first rule that refuses the key in this dialect; nullptr where it is valid.
[[nodiscard]] const Rule* forbidding_rule(const Family& family, const Key& key, std::string_view dialect);

/// Whether a rule holds in a dialect: one of 450, 330, es300.
[[nodiscard]] bool applies_in(const Rule& rule, std::string_view dialect);

/// Groups diagnostics over permutations: one per place and text, its subject the first key and how many more
/// there are. The keys and the family must outlive it.
class DiagnosticGroups {
  public:
    explicit DiagnosticGroups(const Family& family) : family_(family) {}

    /// Both stages of a permutation may say the same: a key counts once in a row.
    void add(const Diagnostic& diagnostic, const Key& key);
    /// In the order in which they were first added.
    [[nodiscard]] Diagnostics result() const;

  private:
    struct Group {
        Diagnostic diagnostic;
        const Key* first = nullptr;
        const Key* last = nullptr;
        std::size_t keys = 0;
    };
    const Family& family_;
    std::map<std::tuple<std::string, int, std::string>, std::size_t> positions_;
    std::vector<Group> groups_;
};

}  // namespace gobo
