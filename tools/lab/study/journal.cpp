#include "lab/study/journal.hpp"

#include <cmath>
#include <limits>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "lab/study/measure.hpp"
#include "lab/study/timing.hpp"

namespace gobo::study {
namespace {

using Json = nlohmann::json;

template <class T, class Wanted>
concept Is = std::is_same_v<std::remove_const_t<T>, Wanted>;

// What is written as an array, in this order,
auto elements(Is<ErrorFigures> auto& figures) {
    return std::tie(figures.max, figures.p999, figures.rms);
}
auto elements(Is<Spread> auto& spread) {
    return std::tie(spread.median, spread.low, spread.high);
}
auto elements(Is<Timing> auto& timing) {
    return std::tie(timing.elapsed.fragment, timing.elapsed.vertex, timing.processor.fragment,
                    timing.processor.vertex, timing.rounds, timing.renderer);
}
auto elements(Is<Control> auto& control) {
    return std::tie(control.elapsed, control.processor);
}

// and what as an object, by these names.
void members(Is<Measurement> auto& measurement, const auto& each) {
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
void members(Is<TimedGroup> auto& group, const auto& each) {
    each("timings", group.timings);
    each("control", group.control);
}

const auto kNothing = [](const char*, auto&) {};
template <class T>
concept HasElements = requires(T& value) {
    elements(value);
};
template <class T>
concept HasMembers = requires(T& value) {
    members(value, kNothing);
};
template <class T>
concept IsList = requires(T& value) {
    value.begin();
}
&&!Is<T, Json> && !Is<T, std::string>;

template <class T>
Json to_json(const T& value) {
    if constexpr (Is<T, double>) {
        return std::isfinite(value) ? Json(value) : Json(nullptr);  // JSON knows no infinity
    } else if constexpr (HasMembers<const T>) {
        Json object;
        members(value, [&](const char* name, const auto& member) { object[name] = to_json(member); });
        return object;
    } else if constexpr (HasElements<const T>) {
        return std::apply([](const auto&... each) { return Json::array({to_json(each)...}); },
                          elements(value));
    } else if constexpr (IsList<const T>) {
        Json array = Json::array();
        for (const auto& each : value) array.push_back(to_json(each));
        return array;
    } else {
        return value;
    }
}

/// Throws what the library throws where the JSON is another thing.
template <class T>
void read(const Json& json, T& value) {
    if constexpr (Is<T, double>) {
        value = json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
    } else if constexpr (HasMembers<T>) {
        members(value, [&](const char* name, auto& member) { read(json.at(name), member); });
    } else if constexpr (HasElements<T>) {
        std::size_t at = 0;
        std::apply([&](auto&... each) { (read(json.at(at++), each), ...); }, elements(value));
    } else if constexpr (IsList<T>) {
        if constexpr (requires { value.resize(1); }) value.resize(json.size());
        for (std::size_t i = 0; i < value.size(); ++i) read(json.at(i), value[i]);
    } else {
        value = json.get<T>();
    }
}

}  // namespace

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
    Measured measured;
    read(Json::parse(found->second), measured);
    return measured;
} catch (const Json::exception&) {
    return std::nullopt;  // written by another gobo: it is measured again
}

template <class Measured>
Result<void> Journal::add(const std::string& identity, const Measured& measured) {
    const Json json = to_json(measured);
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
