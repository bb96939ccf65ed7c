#include "compose/search_path.hpp"

#include <set>

#include <fmt/format.h>

#include "compose/clean_text.hpp"
#include "compose/piece_marks.hpp"
#include "core/text.hpp"

namespace gobo {
namespace {

constexpr std::string_view kExtension = ".glsl";

/// Bytes; no system opens a longer path.
constexpr std::size_t kLongestPath = 4096;

/// The line that marks the name a second time; 0 where none does.
int marked_twice(std::string_view text, std::string_view name) {
    int line = 0;
    int marks = 0;
    for_each_line(text, [&](std::string_view content) {
        ++line;
        return marked(content) != name || ++marks < 2;
    });
    return marks < 2 ? 0 : line;
}

/// What a file holds between the marker of that name and the next one, behind as many empty lines as stand
/// before it: line numbers are the file's. With an empty name, what stands before the first marker, unless
/// that is but a comment on all that follows.
std::optional<std::string> section_of(const std::string& text, const std::string& name) {
    if (text.find("#piece ") == std::string::npos) return name.empty() ? std::optional(text) : std::nullopt;
    std::string section;
    bool is_inside = name.empty();
    bool is_piece = false;  // a marked one may be empty
    for_each_line(text, [&](std::string_view line) {
        const std::optional<std::string_view> mark = marked(line);
        if (mark && is_inside) return false;
        if (mark) is_piece = is_inside = *mark == name;
        if (is_inside && !mark) section += line;
        is_piece = is_piece || (is_inside && !line.empty() && !line.starts_with("//"));
        section += '\n';
        return true;
    });
    return is_piece ? std::optional(std::move(section)) : std::nullopt;
}

std::string path_in(const std::string& folder, const std::string& file) {
    return folder.empty() ? file : folder + "/" + file;
}

/// "a/b.frag" -> "b.frag"
std::string name_of_file(const std::string& path) {
    return path.substr(path.rfind('/') + 1);
}

}  // namespace

bool stays_inside(std::string_view include_path) {
    if (include_path.starts_with('/') || include_path.find('\\') != std::string_view::npos) return false;
    int depth = 0;
    for (const std::string& part : split(include_path, '/')) {
        if (part == "..") --depth;
        if (part != ".." && part != ".") ++depth;
        if (depth < 0) return false;
    }
    return depth > 0;
}

void SearchPath::add(const FileSystem& files, std::string folder, std::string name_prefix, bool on_disk) {
    roots_.push_back({&files, std::move(folder), std::move(name_prefix), on_disk, {}});
}

void SearchPath::add_file(const FileSystem& files, const std::string& path) {
    roots_.insert(roots_.begin() + static_cast<std::ptrdiff_t>(named_files_++),
                  {&files, folder_of(path), "", true, name_of_file(path)});
}

Result<std::optional<Piece>> SearchPath::find(const std::string& include_path,
                                              const std::string& first_folder, Whose whose) const {
    if (include_path.size() > kLongestPath) return std::nullopt;
    for (const bool is_first : {true, false}) {
        for (const Root& root : roots_) {
            const bool goes_first =
                named_files_ > 0 && root.only.empty() && !first_folder.empty() && root.folder == first_folder;
            if (goes_first != is_first || (whose == Whose::shipped && root.name_prefix.empty())) continue;
            Result<std::optional<Piece>> piece = find_in(root, include_path);
            if (!piece || *piece) return piece;
        }
    }
    return std::nullopt;
}

Result<std::optional<Piece>> SearchPath::find_in(const Root& root, const std::string& include_path) {
    if (!root.only.empty() && root.only != include_path) return std::nullopt;
    Result<std::optional<Piece>> piece = read(root, include_path, "");
    const bool can_be_marked = root.only.empty() && include_path.ends_with(kExtension);
    for (std::size_t slash = include_path.rfind('/');
         can_be_marked && piece && !*piece && slash != std::string::npos && slash != 0;
         slash = include_path.rfind('/', slash - 1)) {
        const std::string behind = include_path.substr(slash + 1);
        piece = read(root, include_path.substr(0, slash).append(kExtension),
                     behind.substr(0, behind.size() - kExtension.size()));
    }
    return piece;
}

Result<std::optional<Piece>> SearchPath::read(const Root& root, const std::string& file,
                                              const std::string& section) {
    const bool here = root.folder.empty() || root.folder == ".";
    const std::string path = here ? file : root.folder + "/" + file;
    if (!root.files->is_file(path)) return std::nullopt;
    const std::string real_root = root.files->real_path(here ? "." : root.folder);
    const std::string real_path = root.files->real_path(path);  // as it is where it cannot be followed
    if (root.on_disk && root.only.empty() && real_path.starts_with("/") &&
        !real_path.starts_with(real_root == "/" ? real_root : real_root + "/")) {
        return fail({path, 0, 0}, "",
                    fmt::format("is a link that leads out of '{}'", here ? "." : root.folder),
                    "put the piece itself into the folder, name its folder with -I, or follow such links "
                    "with --follow");
    }
    GOBO_TRY(const std::string bytes, root.files->read(path));
    const std::string text = unix_lines(bytes);
    if (const int line = file.ends_with(kExtension) ? misspelt_mark(text) : 0; line > 0)
        return fail({path, line, 1}, line_of(text, line), "this marks no piece",
                    "write '#piece NAME' at the start of the line");
    if (const int line = section.empty() ? 0 : marked_twice(text, section); line > 0)
        return fail({path, line, 1}, line_of(text, line),
                    fmt::format("the piece '{}' is here twice", section), "give one of them another name");
    std::optional<std::string> found = section_of(text, section);
    if (!found) return std::nullopt;
    const std::string name = root.name_prefix + file + (section.empty() ? "" : "#" + section);
    return Piece{.name = name,
                 .path = path,
                 .text = std::move(*found),
                 .on_disk = root.on_disk,
                 .file_text = section.empty() ? "" : text,
                 .is_shipped = !root.name_prefix.empty()};
}

std::vector<std::string> SearchPath::folders() const {
    std::vector<std::string> folders;
    for (const Root& root : roots_)
        if (root.only.empty()) folders.push_back(root.folder.empty() ? "." : root.folder);
    return folders;
}

std::vector<std::string> SearchPath::all_include_paths() const {
    std::set<std::string> paths;
    for (const Root& root : roots_) {
        if (!root.only.empty()) continue;
        const std::string folder = root.on_disk && root.folder.empty() ? "." : root.folder;
        for (const std::string& file : root.files->files_below(folder)) {
            paths.insert(file);
            if (!file.ends_with(kExtension)) continue;
            const std::string stem = file.substr(0, file.size() - kExtension.size());
            const Result<std::string> text = root.files->read(path_in(folder, file));
            for_each_line(text.value_or(""), [&](std::string_view line) {
                if (const auto mark = marked(line))
                    paths.insert(fmt::format("{}/{}{}", stem, *mark, kExtension));
                return true;
            });
        }
    }
    return {paths.begin(), paths.end()};
}

bool SearchPath::may_hold(std::string_view text) const {
    return std::ranges::any_of(roots_, [&](const Root& root) {
        const auto holds_it = [&](const std::string& file) {
            return root.files->read(path_in(root.folder, file)).value_or("").find(text) != std::string::npos;
        };
        return root.on_disk || std::ranges::any_of(root.files->files_below(root.folder), holds_it);
    });
}

bool is_shader_file(const std::string& path) {
    return path.ends_with(kExtension) || stage_of_file(path);
}

Result<Family> family_of_files(const std::vector<std::string>& paths, const FileSystem& files,
                               SearchPath& search, const std::vector<StageKind>& stages) {
    Family family;
    family.name = "files";
    Templates& templates = family.programs.emplace_back();
    auto next = stages.begin();
    for (const std::string& path : paths) {
        std::optional<StageKind> stage = stage_of_file(path);
        if (!stage && next != stages.end()) stage = *next++;
        if (!stage)
            return fail(Fault::usage, fmt::format("the stage of '{}' is unknown", path),
                        "give it with -S vert, tesc, tese, geom, frag or comp, or name the file *.vert or "
                        "*.vert.glsl");
        if (!files.is_file(path)) return tl::unexpected(files.read(path).error());
        if (!templates[*stage].empty())
            return fail(Fault::usage, fmt::format("'{}' is a second {} stage", path, name_of(*stage)),
                        "name at most one file of each stage");
        templates[*stage] = {name_of_file(path)};
        search.add_file(files, path);
        search.add(files, folder_of(path), "", true);
        if (family.path.empty()) family.path = path;
    }
    if (next != stages.end())
        return fail(
            Fault::usage,
            fmt::format("-S {} is for no file: the other files' names tell their stages", name_of(*next)),
            "leave it out, or name a file whose name does not tell its stage");
    return family;
}

}  // namespace gobo
