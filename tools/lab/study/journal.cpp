#include "lab/study/journal.hpp"

#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "lab/study/measure.hpp"
#include "lab/study/timing.hpp"

namespace gobo::study {

using Json = nlohmann::json;

// How measurements are written: nlohmann/json finds these.

static void to_json(Json& json, const ErrorFigures& figures) {
    json = {figures.max, figures.p999, figures.rms};
}
static void from_json(const Json& json, ErrorFigures& figures) {
    figures = {json.at(0), json.at(1), json.at(2)};
}

static void to_json(Json& json, const Spread& spread) {
    json = {spread.median, spread.low, spread.high};
}
static void from_json(const Json& json, Spread& spread) {
    spread = {json.at(0), json.at(1), json.at(2)};
}

static void to_json(Json& json, const Control& control) {
    json = {control.elapsed, control.processor};
}
static void from_json(const Json& json, Control& control) {
    control = {json.at(0), json.at(1)};
}

static void to_json(Json& json, const Timing& timing) {
    json = {timing.elapsed.fragment, timing.elapsed.vertex, timing.processor.fragment,
            timing.processor.vertex, timing.rounds,         timing.renderer};
}
static void from_json(const Json& json, Timing& timing) {
    timing = {{{json.at(0), json.at(1)}, {json.at(2), json.at(3)}}, json.at(4), json.at(5)};
}

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(TimedGroup, timings, control)

/// Calls `each` with each member and its name.
static void members(auto& measurement, const auto& each) {
    each("total", measurement.total);
    each("rounding", measurement.rounding);
    each("approximation", measurement.approximation);
    each("rate", measurement.rate);
    each("relative", measurement.relative);
    each("vertex_work", measurement.work.vertices);
    each("fragment_work", measurement.work.fragments);
    each("pixels", measurement.pixels);
    each("edges", measurement.edges);
    each("shown_vertices", measurement.shown_vertices);
    each("mesh_vertices", measurement.mesh_vertices);
    each("from_oracle", measurement.from_oracle);
}
static void to_json(Json& json, const Measurement& measurement) {
    members(measurement, [&](const char* name, const auto& member) { json[name] = member; });
}
static void from_json(const Json& json, Measurement& measurement) {
    members(measurement, [&](const char* name, auto& member) { json.at(name).get_to(member); });
}

/// JSON knows no infinity: it is written as null.
static void restore_infinities(Json& json) {
    if (json.is_null()) json = std::numeric_limits<double>::infinity();
    if (!json.is_structured()) return;
    for (Json& each : json) restore_infinities(each);
}

Journal::Journal(const FileSystem& files, std::string path, Append append)
    : path_(std::move(path)), append_(std::move(append)) {
    if (!files.is_file(path_)) return;
    const Result<std::string> text = files.read(path_);
    if (!text) return;
    ends_in_the_middle_ = !text->empty() && text->back() != '\n';
    std::size_t start = 0;
    for (std::size_t end; (end = text->find('\n', start)) != std::string::npos; start = end + 1) {
        const Json line = Json::parse(text->substr(start, end - start), nullptr, false);
        if (line.is_object() && line.contains("identity") && line.contains("measured"))
            known_[line["identity"].get<std::string>()] = line["measured"].dump();
    }
}

template <class Measured>
std::optional<Measured> Journal::find(const std::string& identity) const try {
    const std::lock_guard lock(mutex_);
    const auto found = known_.find(identity);
    if (found == known_.end()) return std::nullopt;
    Json json = Json::parse(found->second);
    if constexpr (!std::is_same_v<Measured, Json>) restore_infinities(json);
    return json.get<Measured>();
} catch (const Json::exception&) {
    return std::nullopt;  // written by another gobo: it is measured again
}

template <class Measured>
Result<void> Journal::add(const std::string& identity, const Measured& measured) {
    const Json json = measured;
    const std::lock_guard lock(mutex_);
    known_[identity] = json.dump();
    if (!append_) return {};
    const Json line = {{"identity", identity}, {"measured", json}};
    const std::string start = ends_in_the_middle_ ? "\n" : "";
    ends_in_the_middle_ = false;
    return append_(path_, start + line.dump() + "\n");
}

template std::optional<Measurement> Journal::find(const std::string&) const;
template std::optional<CurveErrors> Journal::find(const std::string&) const;
template std::optional<TimedGroup> Journal::find(const std::string&) const;
template std::optional<double> Journal::find(const std::string&) const;
template std::optional<Json> Journal::find(const std::string&) const;
template Result<void> Journal::add(const std::string&, const Measurement&);
template Result<void> Journal::add(const std::string&, const CurveErrors&);
template Result<void> Journal::add(const std::string&, const TimedGroup&);
template Result<void> Journal::add(const std::string&, const double&);
template Result<void> Journal::add(const std::string&, const Json&);

std::string identity_of_text(std::string_view text) {
    const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace gobo::study
