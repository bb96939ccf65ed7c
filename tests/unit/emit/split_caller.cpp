// A header whose tables lie in a source file beside the header that has all: both answer the same.

#include "expectations.hpp"
#include "lit.hpp"
#include "split.hpp"

namespace {

split::Key key_of(const lit::Permutation& permutation) {
    return split::permutations[permutation.position].key();
}

}  // namespace

int main() {
    expect(lit::permutations.size() == split::permutations.size(), "how many permutations");
    for (const lit::Permutation& whole : lit::permutations) {
        const std::string name = lit::key_text(whole.key());
        const split::Permutation* apart = split::find(key_of(whole));
        expect(apart == &split::permutations[whole.position] && split::key_text(apart->key()) == name, name);
        if (apart == nullptr) continue;
        expect(whole.vertex.source() == apart->vertex.source() && !apart->vertex.source().empty(),
               name + ", vertex");
        expect(whole.fragment.source() == apart->fragment.source(), name + ", fragment");
        for (int piece = 0; piece < whole.fragment.piece_count(); ++piece)
            expect(whole.fragment.piece(piece).first_line == apart->fragment.piece(piece).first_line &&
                       whole.fragment.piece(piece).name == apart->fragment.piece(piece).name,
                   name + ", a piece");
    }
    split::Key missing;
    missing.point = 8;
    lit::Key lacking;
    lacking.point = 8;
    expect(
        split::find(missing) == nullptr && split::describe_missing(missing) == lit::describe_missing(lacking),
        "what was not built");
    expect(
        split::key_text(split::select(split::SceneState{})) == lit::key_text(lit::select(lit::SceneState{})),
        "select");
    return failures == 0 ? 0 : 1;
}
