#include "validate/known_results.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "core/bytes.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

/// Raised where what is kept, or what it is kept by, changes.
constexpr int kFormat = 3;

/// 16 bytes each. Where there are more, all are forgotten but the newest.
constexpr std::size_t kMostLinks = 1'000'000;

/// What sizes something by its use.
constexpr std::array<std::string_view, 7> kSizedByUse = {
    "gl_ClipDistance", "gl_CullDistance", "gl_TexCoord", "gl_FragData", "gl_in", "gl_out", "gl_SampleMask"};

/// Whether `[]` stands in it.
bool has_unsized_array(std::string_view text) {
    for (std::size_t at = text.find('['); at != std::string_view::npos; at = text.find('[', at + 1)) {
        const std::size_t next = text.find_first_not_of(" \t\n", at + 1);
        if (next != std::string_view::npos && text[next] == ']') return true;
    }
    return false;
}

bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

/// The text without the lines before its first, which only move it.
std::string digits(const Digest& digest) {
    return to_bytes(digest.high, digest.low);
}

}  // namespace

bool sizes_by_use(std::string_view text) {
    return has_unsized_array(text) ||
           std::ranges::any_of(kSizedByUse, [&](std::string_view name) { return contains(text, name); });
}

std::string declarations_of(std::string_view text) {
    if (contains(text, "//") || contains(text, "/*") || contains(text, "\\\n")) return std::string(text);
    std::string declarations;
    int depth = 0;
    int body = 0;   // the depth at which a function's body began
    char last = 0;  // of what is no blank
    for (std::string_view rest = text; !rest.empty();) {
        const std::string_view line = rest.substr(0, std::min(rest.find('\n'), rest.size() - 1) + 1);
        rest.remove_prefix(line.size());
        if (trim(line).starts_with('#')) {
            if (!declarations.empty() && declarations.back() != '\n') declarations += '\n';
            declarations += line;
            continue;
        }
        for (const char character : line) {
            if (character == '{') {
                ++depth;
                if (body == 0 && depth == 1 && last == ')') body = depth;
            }
            if (body == 0 && character != '\n') declarations += character;
            if (character == '}') {
                if (depth == body) body = 0;
                if (--depth < 0) return std::string(text);
            }
            if (character != ' ' && character != '\t' && character != '\n') last = character;
        }
        if (body == 0) declarations += '\n';
    }
    return depth == 0 ? declarations : std::string(text);
}

KnownResults::KnownResults(const Composition& composition, const std::vector<Program>& programs,
                           const std::set<int>& placing, const ValidateOptions& options)
    : composition_(composition),
      programs_(programs),
      options_(options),
      cache_(*options.cache),
      identity_(program_identity()) {
    digest_pieces();
    for (int stage = 0; stage < static_cast<int>(composition.stages.size()); ++stage)
        stages_.push_back(digests_of(stage, placing.contains(stage)));
    const std::optional<std::string> links = cache_.find(key_of_links());
    const auto numbers = links ? from_bytes<std::vector<std::uint64_t>>(*links) : std::nullopt;
    for (std::size_t i = 1; numbers && i < numbers->size(); i += 2)
        links_.insert({(*numbers)[i - 1], (*numbers)[i]});
}

void KnownResults::digest_pieces() {
    for (const Piece& piece : composition_.pieces) {
        const std::string& text = piece.text;
        std::string places = to_bytes(piece.path, piece.first_line, piece.file_text, piece.name);
        for (const auto& [line, moved] : piece.moved_lines)
            places += to_bytes(line, moved.first, moved.second);
        const Digest digest = digest_of(text);
        pieces_.push_back({digest, digest_of(places), digest_of(declarations_of(text)),
                           contains(text, "__LINE__") || contains(text, "__FILE__"), sizes_by_use(text)});
    }
}

KnownResults::OfStage KnownResults::digests_of(int stage, bool is_placing) const {
    const StageKind kind = composition_.stage(stage).kind;
    std::string text = to_bytes(kFormat, identity_, std::string("stage"), kind, is_placing,
                                options_.keep_spirv, options_.debug_information, options_.spirv_val,
                                options_.optimize, options_.strip, composition_.dialect);
    std::string declarations = to_bytes(kind);
    std::string places;
    bool knows_lines = options_.debug_information;
    bool sizes = false;
    for (const int number : composition_.stage(stage).pieces) {
        const OfPiece& piece = pieces_[static_cast<std::size_t>(number)];
        text += digits(piece.text);
        declarations += digits(piece.declarations);
        places += digits(piece.places);
        knows_lines = knows_lines || piece.knows_lines;
        sizes = sizes || piece.sizes_by_use;
    }
    if (knows_lines) text += places;
    if (sizes) declarations = text;
    return {digest_of(text), digest_of(places), digest_of(declarations)};
}

Digest KnownResults::key_of_link(std::size_t program, Digest OfStage::*part) const {
    std::string text = to_bytes(kFormat, identity_, std::string("link"), composition_.dialect);
    for (const int stage : programs_[program]) text += digits(stages_[static_cast<std::size_t>(stage)].*part);
    return digest_of(text);
}

Digest KnownResults::places_of(std::size_t program) const {
    std::string text;
    for (const int stage : programs_[program])
        text += digits(stages_[static_cast<std::size_t>(stage)].places);
    return digest_of(text);
}

std::optional<BatchResult> KnownResults::find(const Digest& key, const Digest& places) const {
    const std::optional<std::string> bytes = cache_.find(key);
    if (!bytes) return std::nullopt;
    // Messages quote their lines: those of other places say something else. None are the same anywhere.
    std::string_view rest = *bytes;
    const std::string here = digits(places);
    const bool has_places = rest.starts_with('m');
    if (rest.empty() || (has_places && rest.substr(1, here.size()) != here)) return std::nullopt;
    return result_of(rest.substr(has_places ? 1 + here.size() : 1));
}

void KnownResults::keep(const Digest& key, const Digest& places, const BatchResult& result) {
    const bool has_messages =
        std::ranges::any_of(result.stages,
                            [](const auto& stage) {
                                return !stage.diagnostics.empty() || !stage.validated.diagnostics.empty();
                            }) ||
        std::ranges::any_of(result.programs,
                            [](const auto& program) { return !program.diagnostics.empty(); });
    cache_.keep(key, (has_messages ? "m" + digits(places) : "p") + bytes_of(result));
}

std::optional<BatchResult::OfStage> KnownResults::stage(int number) const {
    const OfStage& known = stages_[static_cast<std::size_t>(number)];
    std::optional<BatchResult> result = find(known.text, known.places);
    if (!result || result->stages.size() != 1) return std::nullopt;
    result->stages.front().stage = number;
    return std::move(result->stages.front());
}

std::optional<Diagnostics> KnownResults::program(std::size_t number) {
    if (links_.contains(key_of_link(number, &OfStage::declarations))) return Diagnostics{};
    const std::optional<BatchResult> result = find(key_of_link(number, &OfStage::text), places_of(number));
    if (!result || result->programs.size() != 1) return std::nullopt;
    return result->programs.front().diagnostics;
}

void KnownResults::keep(const BatchResult::OfStage& result) {
    const OfStage& known = stages_[static_cast<std::size_t>(result.stage)];
    BatchResult only;
    only.stages.push_back(result);
    only.stages.front().stage = 0;
    keep(known.text, known.places, only);
}

void KnownResults::keep(const BatchResult::OfProgram& result) {
    BatchResult only;
    if (!result.diagnostics.empty()) {
        only.programs.push_back({0, result.diagnostics});
        return keep(key_of_link(result.program, &OfStage::text), places_of(result.program), only);
    }
    const Digest link = key_of_link(result.program, &OfStage::declarations);
    if (links_.insert(link).second) new_links_.insert(link);
}

Digest KnownResults::key_of_links() const {
    return digest_of(to_bytes(kFormat, identity_, std::string("links")));
}

void KnownResults::keep_links() {
    if (new_links_.empty()) return;
    // Of those that another process keeps at the same time some may be lost, to be found out again.
    if (links_.size() > kMostLinks) links_ = std::move(new_links_);
    std::vector<std::uint64_t> numbers;
    for (const Digest& link : links_) numbers.insert(numbers.end(), {link.high, link.low});
    cache_.keep(key_of_links(), to_bytes(numbers));
}

}  // namespace gobo
