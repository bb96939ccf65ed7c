// Messages that several permutations share, said once.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "core/diagnostic.hpp"
#include "family/family.hpp"

namespace gobo {

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
        int keys = 0;
    };
    const Family& family_;
    std::map<std::tuple<std::string, int, std::string>, std::size_t> positions_;
    std::vector<Group> groups_;
};

}  // namespace gobo
