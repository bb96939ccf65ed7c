#include "validate/names_by_place.hpp"

#include <algorithm>
#include <map>
#include <span>

#include "compose/tokens.hpp"
#include "core/text.hpp"
#include "spirv/glsl_type.hpp"

namespace gobo {
namespace {

/// The names that a declaration gives from its `uniform` or `buffer` on: "Block { members } instance;" or
/// "sampler2D image[2];".
void add_names(const std::vector<std::string_view>& tokens, std::size_t at, std::set<std::string>& names) {
    std::vector<std::string> own;
    std::vector<std::string> members;
    int depth = 0;  // of brackets other than a block's own
    bool is_block = false;
    bool is_inside = false;
    if (at + 1 < tokens.size() && tokens[at + 1] == ";") return;  // layout(std140) uniform;
    for (++at; at < tokens.size(); ++at) {
        const std::string_view token = tokens[at];
        if (depth == 0 && token == "{") {
            if (is_identifier(tokens[at - 1])) own.emplace_back(tokens[at - 1]);
            is_block = is_inside = true;
        } else if (depth == 0 && token == "}") {
            is_inside = false;
        } else if (token == "(" || token == "[" || token == ")" || token == "]" || token == "," ||
                   token == ";") {
            const bool is_of_type = token == "[" && !is_inside && !is_block && tokens[at - 2] == "uniform";
            if (depth == 0 && token != "(" && is_identifier(tokens[at - 1]) && !is_of_type)
                (is_inside ? members : own).emplace_back(tokens[at - 1]);
            depth += (token == "(" || token == "[") - (token == ")" || token == "]");
            if (depth == 0 && !is_inside && token == ";") break;
        }
    }
    if (is_block && own.size() < 2) own.insert(own.end(), members.begin(), members.end());
    names.insert(own.begin(), own.end());
}

/// Those of "layout(location = 0) out vec3 normal, tangent[2];".
void add_places(std::span<const std::string_view> tokens, std::map<std::string, std::string>& places) {
    const auto has = [&](std::string_view word) { return std::ranges::count(tokens, word) > 0; };
    if (!has("location") || (!has("in") && !has("out"))) return;
    const auto stated = [&](std::string_view word) {
        std::string text;
        for (auto at = std::ranges::find(tokens, word); at != tokens.end(); ++at) {
            if (*at == "," || *at == ")") break;
            text += *at;
        }
        return text;
    };
    const std::string place = stated("location") + " " + stated("component");
    int depth = 0;  // of brackets
    for (std::size_t at = 0; at + 1 < tokens.size(); ++at) {
        const std::string_view token = tokens[at];
        const std::string_view next = tokens[at + 1];
        depth += (token == "(" || token == "[") - (token == ")" || token == "]");
        const bool is_last = next == "," || next == ";" || next == "[";
        const bool is_type = next == "[" && glsl_type(std::string(token));
        if (depth == 0 && is_last && is_identifier(token) && !is_type) places.emplace(token, place);
    }
}

/// What a stage's text states of the place of each input and output, but for blocks, by its name:
/// "location=0 component=2".
std::map<std::string, std::string> stated_places(const std::vector<const Piece*>& pieces) {
    std::map<std::string, std::string> places;
    for (const Piece* const piece : pieces) {
        if (piece == pieces.front()) continue;  // its macros declare nothing
        const std::vector<std::string_view> tokens = tokens_of(piece->text);
        std::size_t begin = 0;
        for (std::size_t at = 0; at < tokens.size(); ++at) {
            if (tokens[at] == ";") add_places(std::span(tokens).subspan(begin, at + 1 - begin), places);
            if (tokens[at] == ";" || tokens[at] == "{" || tokens[at] == "}") begin = at + 1;
        }
    }
    return places;
}

bool is_plain(std::string_view token) {
    return !is_identifier(token) || token == "location" || token == "component";
}

}  // namespace

std::set<std::string> names_at_two_locations(const std::vector<std::vector<const Piece*>>& stages) {
    std::map<std::string, std::string> known;
    std::set<std::string> names;
    for (const std::vector<const Piece*>& pieces : stages)
        for (const auto& [name, place] : stated_places(pieces)) {
            const auto [other, is_new] = known.emplace(name, place);
            // What a macro stands for may be another location in each stage.
            const bool is_certain = std::ranges::all_of(tokens_of(place), is_plain);
            if (!is_new && (other->second != place || !is_certain)) names.insert(name);
        }
    return names;
}

std::set<std::string> names_of_resources(const std::vector<const Piece*>& pieces) {
    std::set<std::string> names;
    for (const Piece* const piece : pieces) {
        if (piece == pieces.front()) continue;  // its macros declare nothing
        const std::vector<std::string_view> tokens = tokens_of(piece->text);
        for (std::size_t at = 0; at < tokens.size(); ++at)
            if (tokens[at] == "uniform" || tokens[at] == "buffer") add_names(tokens, at, names);
    }
    return names;
}

}  // namespace gobo
