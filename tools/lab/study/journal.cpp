#include "lab/study/journal.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace gobo::study {

Journal::Journal(const FileSystem& files, std::string path, Append append)
    : path_(std::move(path)), append_(std::move(append)) {
    if (!files.is_file(path_)) return;
    const Result<std::string> text = files.read(path_);
    if (!text) return;
    ends_in_the_middle_ = !text->empty() && text->back() != '\n';
    std::size_t start = 0;
    for (std::size_t end; (end = text->find('\n', start)) != std::string::npos; start = end + 1) {
        const auto line = nlohmann::json::parse(text->substr(start, end - start), nullptr, false);
        if (line.is_object() && line.contains("identity") && line.contains("measured"))
            known_[line["identity"].get<std::string>()] = line["measured"].dump();
    }
}

std::optional<nlohmann::json> Journal::find(const std::string& identity) const {
    const std::lock_guard lock(mutex_);
    const auto found = known_.find(identity);
    if (found == known_.end()) return std::nullopt;
    return nlohmann::json::parse(found->second, nullptr, false);
}

Result<void> Journal::add(const std::string& identity, const nlohmann::json& measurement) {
    const std::lock_guard lock(mutex_);
    known_[identity] = measurement.dump();
    if (!append_) return {};
    const nlohmann::json line = {{"identity", identity}, {"measured", measurement}};
    const std::string start = ends_in_the_middle_ ? "\n" : "";
    ends_in_the_middle_ = false;
    return append_(path_, start + line.dump() + "\n");
}

std::string identity_of_text(std::string_view text) {
    const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace gobo::study
