// Where pieces are found: the -I folders, then the family's folder, then the shipped library.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compose/composition.hpp"
#include "core/file_system.hpp"

namespace gobo {

/// Whose files count.
enum class Whose { anyone, shipped };

/// Folders searched in order for an include path.
class SearchPath {
  public:
    /// A folder of `files`. `name_prefix` goes before an include path to make the portable name of what is
    /// found there, and is that of gobo's own folders: those of users have none. `on_disk` says whether a
    /// depfile must name it. `files` must outlive the search path.
    void add(const FileSystem& files, std::string folder, std::string name_prefix, bool on_disk);

    /// One file, found by its name alone and before any folder; a link is followed wherever it leads, since
    /// the user named it.
    void add_file(const FileSystem& files, const std::string& path);

    /// The first piece of that include path ("fog/linear.glsl"), its text as it stands in the file; nothing
    /// where no folder has it. A file may hold several pieces: `fog/linear.glsl` is also what stands in
    /// `fog.glsl` between `#piece linear` and the next such line, its name then `fog.glsl#linear`; a file of
    /// its own goes before. Fault::file where it cannot be read; Fault::input where a link leads out of its
    /// folder. Where files are named by themselves, `first_folder` goes before the others.
    [[nodiscard]] Result<std::optional<Piece>> find(const std::string& include_path,
                                                    const std::string& first_folder = {},
                                                    Whose whose = Whose::anyone) const;

    /// The folders as diagnostics name them.
    [[nodiscard]] std::vector<std::string> folders() const;
    /// The include paths of all files and pieces, sorted, each once.
    [[nodiscard]] std::vector<std::string> all_include_paths() const;
    /// Whether a file may hold the text: those on disk are not read for it.
    [[nodiscard]] bool may_hold(std::string_view text) const;

  private:
    struct Root {
        const FileSystem* files;
        std::string folder;
        std::string name_prefix;
        bool on_disk;
        std::string only;  ///< the one file of the folder that counts; empty: all
    };
    /// A piece of a root's file: behind `#piece SECTION`, or before the first marker.
    static Result<std::optional<Piece>> find_in(const Root& root, const std::string& include_path);
    static Result<std::optional<Piece>> read(const Root& root, const std::string& file,
                                             const std::string& section);

    std::vector<Root> roots_;
    std::size_t named_files_ = 0;  ///< they stand first
};

/// Whether a path is relative and stays within its folder once `.` and `..` are followed.
[[nodiscard]] bool stays_inside(std::string_view include_path);

/// Whether a name looks like a shader file's rather than a family's.
[[nodiscard]] bool is_shader_file(const std::string& path);

/// Shader files that belong to no family, as a family of one key: they are its templates, and their folders
/// are added to `search`. `stages` are, in order, those of the files whose names tell none. At most one file
/// of each stage; Fault::usage otherwise.
[[nodiscard]] Result<Family> family_of_files(const std::vector<std::string>& paths, const FileSystem& files,
                                             SearchPath& search, const std::vector<StageKind>& stages = {});

}  // namespace gobo
