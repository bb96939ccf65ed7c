#include "lab/study/report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/text_template.hpp"
#include "family/key.hpp"
#include "budget/qualities.hpp"
#include "lab/study/report_parts.hpp"

namespace gobo::study {
namespace {

const std::string kTemplates = "templates/study";

std::string effects_options(const ReportInput& input) {
    std::string text;
    for (const EffectsResult& result : input.study.effects) {
        const std::string effects = key_text(input.family, result.effects);
        text += option(effects, effects);
    }
    return text;
}

std::string scene_options(const ReportInput& input) {
    std::string text = option(kAllScenes, "all: worst error, mean cost");
    for (const std::string& scene : input.study.scenes) text += option(scene, scene);
    return text;
}

/// Features by their number among the quality features, as the points state their values.
std::string feature_options(const ReportInput& input) {
    std::string text = option("", "any feature");
    const std::vector<int> features = quality_features(input.family);
    for (std::size_t i = 0; i < features.size(); ++i)
        text += option(std::to_string(i), input.family.features[static_cast<std::size_t>(features[i])].name);
    return text;
}

std::string features_json(const ReportInput& input) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const int index : quality_features(input.family)) {
        const Feature& feature = input.family.features[static_cast<std::size_t>(index)];
        list.push_back({{"name", feature.name}, {"values", feature.values}});
    }
    return list.dump();
}

std::string facts(const ReportInput& input) {
    std::size_t permutations = 0;
    for (const EffectsResult& effects : input.study.effects) permutations += effects.keys.size();
    return fmt::format("{} permutations of {} combinations of effects on {} scenes.", permutations,
                       input.study.effects.size(), input.study.scenes.size());
}

std::string curves_text(const std::map<std::string, Chart>& charts) {
    std::string text;
    for (const auto& [name, chart] : charts) text += "<figure>" + chart.svg() + "</figure>\n";
    return text.empty() ? "<p>None was measured.</p>\n" : text;
}

}  // namespace

Result<std::map<std::string, std::string>> make_report(const FileSystem& shipped, const ReportInput& input) {
    TextTemplate page{kTemplates + "/report.html", {}};
    TemplateValues values;
    for (const auto& [name, target] :
         {std::pair{"report.html", &page.text}, std::pair{"report.css", &values["style"]},
          std::pair{"report.js", &values["script"]}}) {
        Result<std::string> text = shipped.read(kTemplates + "/" + name);
        if (!text) return tl::unexpected(text.error());
        *target = std::move(*text);
    }
    const auto charts = curve_charts(input);
    const Result<std::string> maps = map_figures(input);
    if (!maps) return tl::unexpected(maps.error());
    values["title"] = "What accuracy costs: " + escaped(input.family.name);
    values["facts"] = facts(input);
    values["effects_options"] = effects_options(input);
    values["scene_options"] = scene_options(input);
    values["feature_options"] = feature_options(input);
    values["scatters"] = scatter_figures(input);
    values["choices"] = choices_table(input);
    values["curves"] = curves_text(charts);
    values["heat_scale"] = heat_scale();
    values["maps"] = *maps;
    values["time"] = time_section(input);
    values["changes"] = changes_section(input);
    values["guards"] = guards_section(input);
    values["method"] = method_section(input);
    values["features"] = features_json(input);
    Result<std::string> html = fill(page, values);
    if (!html) return tl::unexpected(html.error());
    std::map<std::string, std::string> files;
    files["index.html"] = std::move(*html);
    const std::string shown = key_text(input.family, input.study.effects.back().effects);
    files["front.svg"] = scatter_of(input, shown, kAllScenes).svg();
    for (const auto& [name, chart] : charts) files[name] = chart.svg();
    return files;
}

}  // namespace gobo::study
