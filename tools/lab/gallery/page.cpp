#include <algorithm>
#include <charconv>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text_template.hpp"
#include "family/key.hpp"
#include "lab/gallery/gallery.hpp"

namespace gobo::gallery {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kTemplate = "templates/gallery/index.html.in";

std::string value_text(const Feature& feature, int value) {
    return feature.kind == FeatureKind::count ? std::to_string(value)
                                              : feature.values[static_cast<std::size_t>(value)];
}

/// Three digits tell costs apart; more would suggest an exactness that an average has not.
double to_three_digits(double number) {
    const std::string text =
        fmt::format("{:.3g}", number);  // of the doubles nearby the one that is shown as this
    double rounded = 0;
    std::from_chars(text.data(), text.data() + text.size(), rounded);
    return rounded;
}

/// Each feature with those of its values that occur, in the family's order.
Json features_of(const Family& family, const Gallery& gallery) {
    Json features = Json::array();
    for (std::size_t i = 0; i < family.features.size(); ++i) {
        std::vector<int> occurring;
        for (const Entry& entry : gallery.entries) occurring.push_back(entry.key[i]);
        std::sort(occurring.begin(), occurring.end());
        occurring.erase(std::unique(occurring.begin(), occurring.end()), occurring.end());
        Json values = Json::array();
        for (const int value : occurring) values.push_back(value_text(family.features[i], value));
        features.push_back({{"name", family.features[i].name}, {"index", i}, {"values", std::move(values)}});
    }
    return features;
}

Json entry_json(const Family& family, const Entry& entry) {
    Json values = Json::array();
    for (std::size_t i = 0; i < family.features.size(); ++i)
        values.push_back(value_text(family.features[i], entry.key[i]));
    return {{"key", key_text(family, entry.key)},
            {"values", std::move(values)},
            {"actual", entry.actual},
            {"expected", entry.expected},
            {"difference", entry.difference},
            {"largest_error", entry.largest_error},
            {"root_mean_square", entry.root_mean_square},
            {"edges", entry.edges},
            {"pixels", entry.pixels},
            {"exposure", to_three_digits(entry.exposure)},
            {"fragment_cost", to_three_digits(entry.fragment_cost)},
            {"vertex_cost", to_three_digits(entry.vertex_cost)}};
}

/// JSON within a <script> element: `</` would end it.
std::string script_text(const Json& json) {
    std::string text = json.dump();
    for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at))
        text.replace(at, 2, "<\\/");
    return text;
}

/// Text within an element or an attribute.
std::string html_text(std::string_view text) {
    std::string result;
    for (const char character : text) {
        switch (character) {
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '&':
                result += "&amp;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += character;
        }
    }
    return result;
}

}  // namespace

Result<std::string> page(const FileSystem& shipped, const Family& family, const Gallery& gallery) {
    const Result<std::string> text = shipped.read(kTemplate);
    if (!text) return tl::unexpected(text.error());
    Json entries = Json::array();
    for (const Entry& entry : gallery.entries) entries.push_back(entry_json(family, entry));
    const std::string about = fmt::format(
        "Each permutation drawn by {} and evaluated in single precision without a renderer. Error: the "
        "largest "
        "difference of linear radiance between the two, but for pixels at an edge. Cost: the operations of a "
        "fragment and of a vertex on average, weighted by what they cost on {}, in additions.",
        gallery.renderer, gallery.cost_renderer);
    const Json data = {{"family", family.name},
                       {"about", about},
                       {"renderer", gallery.renderer},
                       {"width", gallery.width},
                       {"height", gallery.height},
                       {"white_error", gallery.white_error},
                       {"features", features_of(family, gallery)},
                       {"entries", std::move(entries)}};
    return fill({kTemplate, *text},
                {{"title", html_text("Permutations of " + family.name)}, {"data", script_text(data)}});
}

}  // namespace gobo::gallery
