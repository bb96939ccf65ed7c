// What a generated header is made of: pieces of text, stages as lists of pieces, packed keys and their
// search. Plain data and constant functions; no OpenGL.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gobo::runtime {

/// One text of a stage. A long file is cut into several pieces, so that no literal exceeds what compilers
/// take; so is one that differs little between stages, such as the prologue.
struct Piece {
    std::string_view name;  ///< the file, and the piece in it: "shader_lib/fog.glsl#linear"
    std::string_view text;
    int first_line = 1;  ///< the line of the file at which `text` starts; in a header's table 0 where that
                         ///< follows from the piece before it
};

/// `Count` whole numbers as text, `Digits` characters from '0' to 'o' each: six bits a character, the first
/// ones weigh most. Compilers read a literal many times as fast as a list of numbers.
template <int Digits, std::size_t Count>
struct NumberText {
    /// As many numbers as a literal that every compiler takes.
    static constexpr std::size_t in_row = Count < 4000 ? Count : 4000;
    char rows[(Count + in_row - 1) / in_row][in_row * Digits + 1];

    [[nodiscard]] constexpr std::uint32_t operator[](std::size_t position) const {
        const char* digits = rows[position / in_row] + position % in_row * Digits;
        std::uint32_t number = 0;
        for (int digit = 0; digit < Digits; ++digit)
            number = number * 64 + static_cast<std::uint32_t>(digits[digit] - '0');
        return number;
    }
};

/// Where a header's tables have the stages of one kind: each is a row of digits, and each column has lists of
/// pieces of which the digit chooses one.
struct StageTable {
    std::uint32_t first_stage;
    std::uint32_t first_digit;
    std::uint32_t first_column;
    std::uint32_t columns;
};

/// In the order in which a pipeline runs them. A compute stage is a program of its own.
enum class StageKind { vertex, tess_control, tess_evaluation, geometry, fragment, compute };

/// "vertex" or "tess_control".
[[nodiscard]] constexpr std::string_view name_of(StageKind kind) {
    constexpr std::string_view names[] = {"vertex",   "tess_control", "tess_evaluation",
                                          "geometry", "fragment",     "compute"};
    return names[static_cast<std::size_t>(kind)];
}

/// A stage of a permutation: an index into the tables of its generated header.
template <class Tables>
struct Stage {
    std::uint32_t number = 0;

    /// Whether the permutation has the stage: others of its family may have one that it lacks.
    [[nodiscard]] constexpr bool exists() const { return piece_count() > 0; }
    /// How many texts for_each_piece() passes.
    [[nodiscard]] constexpr int piece_count() const {
        int count = 0;
        for_each_number([&count](std::size_t) { ++count; });
        return count;
    }
    /// The piece at a position from 0 to piece_count() - 1.
    [[nodiscard]] constexpr Piece piece(int position) const {
        Piece found;
        for_each_number([&found, &position](std::size_t piece) {
            if (position-- < 0) return;
            int line = found.first_line;
            for (const char character : found.text) line += character == '\n' ? 1 : 0;
            found = Tables::pieces[piece];
            if (found.first_line == 0) found.first_line = line;
        });
        return found;
    }
    /// Calls `callback(std::string_view)` with each text in order. One after the other they are the source;
    /// glShaderSource takes them as they are, with their lengths (they may lack a terminating zero).
    template <class Callback>
    constexpr void for_each_piece(Callback&& callback) const {
        for_each_number([&callback](std::size_t piece) { callback(Tables::pieces[piece].text); });
    }
    /// The whole source as one text.
    [[nodiscard]] std::string source() const {
        std::string whole;
        for_each_piece([&whole](std::string_view text) { whole += text; });
        return whole;
    }
    friend constexpr bool operator==(const Stage& left, const Stage& right) {
        return left.number == right.number;
    }
    friend constexpr bool operator!=(const Stage& left, const Stage& right) { return !(left == right); }

  private:
    /// Calls `callback(std::size_t)` with the number of each piece in order.
    template <class Callback>
    constexpr void for_each_number(Callback callback) const {
        StageTable table{};
        for (const StageTable& other : Tables::stage_tables)
            if (other.first_stage <= number) table = other;
        const std::size_t row = table.first_digit + std::size_t{number - table.first_stage} * table.columns;
        for (std::size_t column = 0; column < table.columns; ++column) {
            const std::size_t list =
                Tables::first_lists[table.first_column + column] + Tables::stage_digits[row + column];
            for (std::size_t at = Tables::list_begins[list]; at < Tables::list_begins[list + 1]; ++at)
                callback(std::size_t{Tables::list_pieces[at]});
        }
    }
};

namespace detail {

/// Of a family with other stages than the usual two.
template <class Permutation, class Callback>
constexpr auto call_for_each_stage(const Permutation& permutation, Callback& callback, int)
    -> decltype(permutation.for_each_stage(callback)) {
    permutation.for_each_stage(callback);
}
template <class Permutation, class Callback>
constexpr void call_for_each_stage(const Permutation& permutation, Callback& callback, long) {
    callback(StageKind::vertex, permutation.vertex);
    callback(StageKind::fragment, permutation.fragment);
}

}  // namespace detail

/// Calls `callback(StageKind, stage)` for each stage of a permutation, in the order of the pipeline.
template <class Permutation, class Callback>
constexpr void for_each_stage(const Permutation& permutation, Callback&& callback) {
    detail::call_for_each_stage(permutation, callback, 0);
}

/// A packed key of a family whose features need more than 64 bits. The first word weighs most.
template <std::size_t Words>
struct WideKey {
    std::array<std::uint64_t, Words> words;

    friend constexpr bool operator==(const WideKey& left, const WideKey& right) {
        std::uint64_t difference = 0;
        for (std::size_t word = 0; word < Words; ++word) difference |= left.words[word] ^ right.words[word];
        return difference == 0;
    }
    friend constexpr bool operator<(const WideKey& left, const WideKey& right) {
        unsigned less = 0;
        for (std::size_t word = Words; word-- > 0;) {
            const unsigned below = left.words[word] < right.words[word] ? 1U : 0U;
            const unsigned same = left.words[word] == right.words[word] ? 1U : 0U;
            less = below | (same & less);
        }
        return less != 0;
    }
};

/// The first position in sorted `keys` whose key is not below `wanted`; Count where all are.
/// The number of steps depends on Count alone and each step is an addition, not a jump: nothing to
/// mispredict.
template <class Packed, std::size_t Count>
[[nodiscard]] constexpr std::size_t lower_bound(const std::array<Packed, Count>& keys, const Packed& wanted) {
    std::size_t first = 0;
    for (std::size_t length = Count; length > 0; length /= 2) {
        const std::size_t half = length / 2;
        first += static_cast<std::size_t>(keys[first + half] < wanted) * (length - half);
    }
    return first;
}

/// Whose row of a table it is: of all permutations, or of those whose declared(differing) is `number`, where
/// others declare the name in another way.
struct Only {
    int differing = -1;
    int number = 0;

    template <class Permutation>
    [[nodiscard]] constexpr bool applies_to(const Permutation& permutation) const {
        return differing < 0 || permutation.declared(differing) == number;
    }
};

/// The binding point of a uniform block, for dialects that cannot state it in the shader.
struct BlockBinding {
    std::string_view name;
    int binding = 0;
    Only only = {};
};

/// The texture unit of a sampler; an array of samplers takes `count` units from `binding` on.
struct SamplerBinding {
    std::string_view name;
    std::string_view type;  ///< the GLSL type
    int binding = 0;
    int count = 1;
    Only only = {};
};

/// A vertex attribute or a fragment output.
struct VariableLocation {
    std::string_view name;
    std::string_view type;  ///< the GLSL type
    int location = -1;      ///< -1 where the driver chooses
    Only only = {};
};

/// A uniform outside any block.
struct UniformLocation {
    std::string_view name;
    std::string_view type;  ///< the GLSL type
    int location = -1;      ///< -1 where the driver chooses: ask glGetUniformLocation
    int count = 1;          ///< elements of an array
    Only only = {};
};

}  // namespace gobo::runtime
