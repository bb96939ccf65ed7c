#include "reflect_witness.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gobo::testing {
namespace {

using Json = nlohmann::json;
using Lines = std::vector<std::string>;

std::string block_line(const std::string& name, int binding, int size) {
    return fmt::format("block {}: binding {}, {} bytes", name, binding, size);
}

std::string resource_line(std::string_view kind, const std::string& name, const std::string& type,
                          const std::vector<int>& array, int place) {
    return fmt::format("{} {}: {}{} at {}", kind, name, type, array, place);
}

/// spirv-cross knows no locations inside structs.
std::string variable_line(std::string_view kind, const std::string& name, const std::string& type,
                          const std::vector<int>& array, int location) {
    const bool inside = name.find('.') != std::string::npos;
    return resource_line(kind, name, type, array, inside ? -1 : location);
}

void add_member_lines(Lines& lines, const std::string& path, const std::vector<Member>& members) {
    for (const Member& member : members) {
        const std::string name = path + "." + member.name;
        lines.push_back(fmt::format("{}: {}{} at {}, array stride {}, matrix stride {}, {}", name,
                                    member.type, member.array, member.offset, member.array_stride,
                                    member.matrix_stride, member.row_major ? "rows" : "columns"));
        add_member_lines(lines, name, member.members);
    }
}

void add_block_lines(Lines& lines, const std::vector<Block>& blocks) {
    for (const Block& block : blocks) {
        lines.push_back(block_line(block.name, block.binding, block.size));
        add_member_lines(lines, block.name, block.members);
    }
}

/// spirv-cross lists extents from the inside out.
std::vector<int> extents(const Json& entry) {
    std::vector<int> array = entry.value("array", std::vector<int>());
    std::ranges::reverse(array);
    return array;
}

/// Structs stand in a table of types, under names that begin with an underscore.
class Witness {
  public:
    explicit Witness(Json reflection) : reflection_(std::move(reflection)) {}

    [[nodiscard]] Lines lines() const {
        Lines lines;
        for (const char* const kind : {"ubos", "ssbos"}) add_blocks(lines, kind);
        for (const char* const kind : {"textures", "images"}) {
            for (const Json& entry : list(kind)) {
                lines.push_back(resource_line("sampler", entry["name"], entry["type"], extents(entry),
                                              entry.value("binding", -1)));
            }
        }
        for (const Json& entry : list("inputs")) add_variable(lines, "input", entry, entry["name"]);
        for (const Json& entry : list("outputs")) add_variable(lines, "output", entry, entry["name"]);
        std::ranges::sort(lines);
        return lines;
    }

  private:
    [[nodiscard]] Json list(const char* kind) const { return reflection_.value(kind, Json::array()); }

    [[nodiscard]] const Json* structure(const std::string& type) const {
        return reflection_.contains("types") && reflection_["types"].contains(type)
                   ? &reflection_["types"][type]
                   : nullptr;
    }

    void add_blocks(Lines& lines, const char* kind) const {
        for (const Json& entry : list(kind)) {
            const std::vector<int> array = extents(entry);
            // A block's size there ends with its last member; OpenGL rounds it up to whole vec4s.
            const int size = (entry["block_size"].get<int>() + 15) / 16 * 16;
            for (int i = 0; i < (array.empty() ? 1 : array[0]); ++i) {
                std::string name = entry["name"];
                if (!array.empty()) name += fmt::format("[{}]", i);
                const int binding = entry.value("binding", -1);
                lines.push_back(block_line(name, binding < 0 ? -1 : binding + i, size));
                add_members(lines, name, entry["type"]);
            }
        }
    }

    void add_members(Lines& lines, const std::string& path, const std::string& type) const {
        for (const Json& member : (*structure(type))["members"]) {
            const std::string name = path + "." + member["name"].get<std::string>();
            const std::string member_type = member["type"];
            const Json* const inner = structure(member_type);
            lines.push_back(fmt::format("{}: {}{} at {}, array stride {}, matrix stride {}, {}", name,
                                        inner == nullptr ? member_type : (*inner)["name"].get<std::string>(),
                                        extents(member), member.value("offset", 0),
                                        member.value("array_stride", 0), member.value("matrix_stride", 0),
                                        member.value("row_major", false) ? "rows" : "columns"));
            if (inner != nullptr) add_members(lines, name, member_type);
        }
    }

    void add_variable(Lines& lines, const char* kind, const Json& entry, const std::string& path) const {
        const Json* const inner = structure(entry["type"]);
        const std::vector<int> array = extents(entry);
        if (inner == nullptr) {
            lines.push_back(variable_line(kind, path, entry["type"], array, entry.value("location", -1)));
            return;
        }
        for (int i = 0; i < (array.empty() ? 1 : array[0]); ++i) {
            const std::string element = array.empty() ? path : fmt::format("{}[{}]", path, i);
            for (const Json& member : (*inner)["members"]) {
                add_variable(lines, kind, member, element + "." + member["name"].get<std::string>());
            }
        }
    }

    Json reflection_;
};

std::string output_of(const std::string& command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string output;
    char buffer[4096];
    while (pipe != nullptr) {
        const std::size_t count = fread(buffer, 1, sizeof buffer, pipe.get());
        if (count == 0) break;
        output.append(buffer, count);
    }
    return output;
}

}  // namespace

std::vector<std::string> facts_of(const Interface& interface) {
    Lines lines;
    add_block_lines(lines, interface.blocks);
    add_block_lines(lines, interface.storage_blocks);
    for (const Sampler& sampler : interface.samplers) {
        lines.push_back(resource_line("sampler", sampler.name, sampler.type, sampler.array, sampler.binding));
    }
    for (const Variable& input : interface.inputs) {
        lines.push_back(variable_line("input", input.name, input.type, input.array, input.location));
    }
    for (const Variable& output : interface.outputs) {
        lines.push_back(variable_line("output", output.name, output.type, output.array, output.location));
    }
    std::ranges::sort(lines);
    return lines;
}

std::vector<std::string> facts_of_spirv_cross(const std::vector<std::uint32_t>& spirv,
                                              const std::string& name) {
    const std::string path = ::testing::TempDir() + "gobo_reflect_" + name + ".spv";
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(spirv.data()), static_cast<std::streamsize>(spirv.size() * 4));
    const std::string output = output_of("spirv-cross '" + path + "' --reflect");
    std::remove(path.c_str());
    const Json reflection = Json::parse(output, nullptr, false);
    if (reflection.is_discarded()) return {"spirv-cross said: " + output};
    return Witness(reflection).lines();
}

}  // namespace gobo::testing
