#include "compose/varyings.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

struct VaryingPlace {
    int location;
    int elements;  ///< of an array; 0 for a single one
};

/// Where the varyings stand: at the locations that the family states, arrays behind them. Where the gaps
/// between them lead past the locations that every implementation has, they stand without gaps.
std::vector<VaryingPlace> places_of(const Family& family, const std::vector<int>& varyings, const Key& key) {
    constexpr int kGuaranteedLocations = 15;  // MAX_VARYING_COMPONENTS / 4
    std::vector<VaryingPlace> places;
    std::vector<VaryingPlace> packed;
    int behind = 0;  // the first location that is still free
    int packed_behind = 0;
    for (const int index : varyings) {
        const Varying& varying = family.varyings[static_cast<std::size_t>(index)];
        int values = 0;
        for (const int feature : varying.counts) {
            const auto at = static_cast<std::size_t>(feature);
            values += family.features[at].lowest + key[at];
        }
        const int elements = (values + varying.values_per_element - 1) / varying.values_per_element;
        const int locations = location_count(varying.type, {std::max(elements, 1)});
        places.push_back({varying.counts.empty() ? varying.location : behind, elements});
        packed.push_back({packed_behind, elements});
        behind = std::max(behind, places.back().location + locations);
        packed_behind += locations;
    }
    return behind > kGuaranteedLocations ? packed : places;
}

}  // namespace

std::vector<int> varyings_read(const Family& family, const PieceLibrary& library,
                               const std::vector<int>& fragment) {
    std::vector<int> read;
    for (std::size_t i = 0; i < family.varyings.size(); ++i)
        if (library.mentions(fragment, family.varyings[i].name)) read.push_back(static_cast<int>(i));
    return read;
}

Piece varyings_piece(const Family& family, const std::vector<int>& varyings, const Key& key,
                     StageKind stage) {
    std::map<int, std::string> lines;
    std::string calls;
    std::string path = family.path;
    const std::vector<VaryingPlace> places = places_of(family, varyings, key);
    for (std::size_t i = 0; i < varyings.size(); ++i) {
        const Varying& varying = family.varyings[static_cast<std::size_t>(varyings[i])];
        if (i == 0) path = varying.place.file;
        std::string& line = lines[varying.place.line];
        line +=
            fmt::format("{}{}VARYING({}) {} {}{};", varying.interpolation,
                        varying.interpolation.empty() ? "" : " ", places[i].location, varying.type,
                        varying.name, varying.counts.empty() ? "" : fmt::format("[{}]", places[i].elements));
        if (stage == StageKind::fragment) continue;
        std::string writer = "writeVarying" + varying.name;
        char& initial = writer[writer.size() - varying.name.size()];
        if (initial >= 'a' && initial <= 'z') initial = static_cast<char>(initial - 'a' + 'A');
        line += fmt::format(" void {}() {{ {} = {}; }}", writer, varying.name, varying.value);
        calls += fmt::format("    {}();\n", writer);
    }
    std::string text;
    int at = 1;
    for (const auto& [line, declaration] : lines) {
        text.append(static_cast<std::size_t>(std::max(line - at, 0)), '\n');
        text += declaration + "\n";
        at = line + 1;
    }
    if (stage == StageKind::vertex) text += fmt::format("void writeVaryings() {{\n{}}}\n", calls);
    return {fmt::format("{}[varyings]", family.name), std::move(path), std::move(text), false};
}
}  // namespace gobo
