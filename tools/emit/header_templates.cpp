#include "emit/header_templates.hpp"

namespace gobo {

Result<HeaderTemplates> read_header_templates(const FileSystem& files, const std::string& folder) {
    HeaderTemplates templates;
    templates.header.name = folder + "/header.hpp.in";
    templates.structure.name = folder + "/struct.hpp.in";
    for (TextTemplate* part : {&templates.header, &templates.structure}) {
        Result<std::string> text = files.read(part->name);
        if (!text) return tl::make_unexpected(std::move(text.error()));
        part->text = std::move(*text);
    }
    return templates;
}

}  // namespace gobo
