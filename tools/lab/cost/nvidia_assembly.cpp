#include "lab/cost/nvidia_assembly.hpp"

#include <algorithm>
#include <charconv>

#include "core/text.hpp"

namespace gobo::cost {
namespace {

/// Results per cycle of a quarter of a multiprocessor, and the warps that a whole one keeps.
struct Architecture {
    std::string_view name;
    std::uint64_t additions;        ///< float additions, multiplications, fused ones
    std::uint64_t others;           ///< comparisons, integers, moves, conversions
    std::uint64_t transcendentals;  ///< reciprocals, roots, exp2, log2, sin, cos
    std::uint64_t warps;
};

const Architecture& architecture_named(std::string_view name) {
    static constexpr Architecture kArchitectures[] = {{"Maxwell", 32, 16, 8, 64},
                                                      {"Pascal", 32, 16, 8, 64},
                                                      {"Volta", 16, 16, 4, 64},
                                                      {"Turing", 16, 16, 4, 32},
                                                      {"Ampere", 32, 16, 4, 48}};
    for (const Architecture& architecture : kArchitectures)
        if (architecture.name == name) return architecture;
    return kArchitectures[std::size(kArchitectures) - 1];
}

Kind kind_of(std::string_view name, bool is_uniform) {
    using enum Kind;
    struct Row {
        std::string_view begins;
        Kind kind;
    };
    // The first that fits.
    static constexpr Row kRows[] = {{"ipa", interpolation},
                                    {"ldtram", interpolation},
                                    {"mufu", transcendental},
                                    {"rro", transcendental},
                                    {"tex", texture},
                                    {"tld", texture},
                                    {"txd", texture},
                                    {"txq", texture},
                                    {"tmml", texture},
                                    {"suld", texture},
                                    {"sust", texture},
                                    {"suatom", texture},
                                    {"ast", output},
                                    {"out", output},
                                    {"bra", branch},
                                    {"brk", branch},
                                    {"exit", branch},
                                    {"kill", branch},
                                    {"kil", branch},
                                    {"cont", branch},
                                    {"ssy", branch},
                                    {"sync", branch},
                                    {"pbk", branch},
                                    {"pcnt", branch},
                                    {"bssy", branch},
                                    {"bsync", branch},
                                    {"break", branch},
                                    {"bclear", branch},
                                    {"bmov", branch},
                                    {"warpsync", branch},
                                    {"nop", wait},
                                    {"bar", wait},
                                    {"membar", wait},
                                    {"depbar", wait},
                                    {"cctl", wait},
                                    {"ald", memory},
                                    {"al2p", memory},
                                    {"isberd", memory},
                                    {"ld", memory},
                                    {"st", memory},
                                    {"atom", memory},
                                    {"pixld", memory},
                                    {"mov", move},
                                    {"s2r", move},
                                    {"cs2r", move},
                                    {"r2ur", move}};
    for (const Row& row : kRows)
        if (name.starts_with(row.begins)) return is_uniform && row.kind == move ? scalar : row.kind;
    return is_uniform ? scalar : arithmetic;
}

bool is_addition(std::string_view name) {
    return name.starts_with("fadd") || name.starts_with("fmul") || name.starts_with("ffma");
}

/// The number that the text begins with.
std::uint64_t number_at(std::string_view text) {
    std::uint64_t number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

/// "up0" or "ur1": a register that the whole warp shares.
bool is_uniform_register(std::string_view word) {
    return word.size() > 2 && word[0] == 'u' && (word[1] == 'r' || word[1] == 'p') && word[2] >= '0' &&
           word[2] <= '9';
}

/// "@!p0 r0 = fadd.ftz r1 r2" in its parts.
struct Statement {
    std::string_view name;         ///< "fadd.ftz"; empty where the line holds no instruction
    std::string_view destination;  ///< the first
};

Statement statement_of(std::string_view text) {
    text = trim(text);
    if (text.starts_with('@')) text = trim(text.substr(std::min(text.find(' '), text.size())));
    Statement statement;
    if (const std::size_t equals = text.find(" = "); equals != std::string_view::npos) {
        statement.destination = text.substr(0, std::min(text.find(' '), text.size()));
        text = trim(text.substr(equals + 3));
    }
    statement.name = text.substr(0, std::min(text.find(' '), text.size()));
    return statement;
}

std::uint64_t divided_up(std::uint64_t number, std::uint64_t by) {
    return (number + by - 1) / by;
}

}  // namespace

NvidiaCode read_nvidia_assembly(std::string_view text, std::string_view architecture) {
    const Architecture& rates = architecture_named(architecture);
    NvidiaCode code;
    std::uint64_t issued = 0;
    std::uint64_t additions = 0;
    std::uint64_t others = 0;
    std::uint64_t transcendentals = 0;
    std::uint64_t block = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = trim(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.starts_with("block")) {  // "block.u 3 L7 [2] -> {"
            block = number_at(line.substr(std::min(line.find(' ') + 1, line.size())));
            continue;
        }
        if (line.starts_with('}')) {  // "} -> [3, 49]": the blocks that follow
            const std::size_t open = line.find('[');
            if (open == std::string_view::npos) continue;
            for (const std::string& next : split(line.substr(open + 1, line.find(']') - open - 1), ','))
                code.has_loop = code.has_loop || number_at(next) <= block;
            continue;
        }
        const std::size_t comment = line.find("//");
        if (comment == std::string_view::npos || line.starts_with("====")) continue;
        if (const std::size_t delay = line.find("delay="); delay != std::string_view::npos)
            code.latency += number_at(line.substr(delay + 6));
        const Statement statement = statement_of(line.substr(0, comment));
        if (statement.name.empty()) continue;
        const bool is_uniform = is_uniform_register(statement.destination);
        if (is_uniform && statement.destination[1] == 'r')
            code.uniform_registers =
                std::max(code.uniform_registers, number_at(statement.destination.substr(2)) + 1);
        const Kind kind = kind_of(statement.name, is_uniform);
        ++code.kinds[static_cast<std::size_t>(kind)];
        ++issued;
        if (kind == Kind::transcendental || kind == Kind::interpolation)
            ++transcendentals;
        else if (is_addition(statement.name))
            ++additions;
        else if (kind == Kind::arithmetic || kind == Kind::move)
            ++others;
    }
    constexpr std::uint64_t kWarp = 32;
    code.cycles = std::max({issued, divided_up(additions * kWarp, rates.additions),
                            divided_up(others * kWarp, rates.others),
                            divided_up(transcendentals * kWarp, rates.transcendentals)});
    return code;
}

std::uint64_t nvidia_occupancy(std::uint64_t registers, std::string_view architecture) {
    constexpr std::uint64_t kRegisters = 65536 / 4;
    const std::uint64_t of_warp = 32 * divided_up(std::max<std::uint64_t>(registers, 1), 8) * 8;
    return std::min(architecture_named(architecture).warps / 4, kRegisters / of_warp);
}

}  // namespace gobo::cost
