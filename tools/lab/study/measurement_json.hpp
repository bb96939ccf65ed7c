// Measurements on their way into the journal and back.
#pragma once

#include <optional>

#include <nlohmann/json_fwd.hpp>

#include "lab/study/measure.hpp"
#include "lab/study/timing.hpp"

namespace gobo::study {

[[nodiscard]] nlohmann::json to_json(const ErrorFigures& figures);
[[nodiscard]] nlohmann::json to_json(const Measurement& measurement);

[[nodiscard]] nlohmann::json to_json(const TimedGroup& group);

/// Nothing where the JSON is none of these.
[[nodiscard]] std::optional<ErrorFigures> error_figures_of(const nlohmann::json& json);
[[nodiscard]] std::optional<Measurement> measurement_of(const nlohmann::json& json);
[[nodiscard]] std::optional<TimedGroup> timed_group_of(const nlohmann::json& json);

}  // namespace gobo::study
