#include "validate/stage_rules.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "compose/dialect.hpp"
#include "compose/rewrite.hpp"
#include "core/numbers.hpp"
#include "reflect/reflect.hpp"
#include "spirv/glsl_type.hpp"
#include "validate/declaration.hpp"
#include "validate/glslang_log.hpp"
#include "validate/guarantees.hpp"
#include "validate/member_offsets.hpp"

namespace gobo {
namespace {

using spirv::Id;
using spirv::kWhole;
using spirv::Part;

class StageCheck {
  public:
    StageCheck(const spirv::Module& module, const spirv::Usage& usage, const Interface& interface,
               const std::vector<const Piece*>& pieces, Dialect dialect)
        : module_(module),
          usage_(usage),
          interface_(interface),
          pieces_(pieces),
          dialect_(dialect),
          kind_(static_cast<StageKind>(module.entry_points.front().model)) {}

    Diagnostics run(bool places_vertices) {
        check_language();
        if (places_vertices) check_position();
        if (kind_ == StageKind::compute) check_local_size();
        if (kind_ == StageKind::geometry) check_vertices();
        if (kind_ == StageKind::geometry) check_streams();
        check_sizes();
        check_array_sizes();
        check_writeonly();
        for (Diagnostic& misplaced : check_member_offsets(module_, interface_, pieces_, dialect_))
            found_.push_back(std::move(misplaced));
        if (kind_ == StageKind::fragment) {
            for (const spirv::Variable& variable : module_.variables)
                if (variable.storage == spv::StorageClassOutput) check_output(variable);
            check_early_tests();
            check_built_in_arrays();
        }
        return std::move(found_);
    }

  private:
    void warn(const Declaration& at, std::string message, std::string help) {
        found_.push_back(diagnostic_at(at, Severity::warning, std::move(message), std::move(help)));
    }

    void refuse(const Declaration& at, std::string message, std::string help) {
        found_.push_back(diagnostic_at(at, Severity::error, std::move(message), std::move(help)));
    }

    /// What glslang takes although OpenGL, or the version, has it not.
    void check_language() {
        for (const auto& [place, literal] : module_.decorations)
            if (std::get<spv::Decoration>(place) == spv::DecorationSpecId && !is_spirv(dialect_)) {
                const auto is_used = [&](std::string_view word) {
                    return use_of(word, pieces_).place.line > 0;
                };
                constexpr std::array<std::string_view, 4> kWords = {"constant_id", "local_size_x_id",
                                                                    "local_size_y_id", "local_size_z_id"};
                const auto word = std::ranges::find_if(kWords, is_used);
                const std::string_view said = word == kWords.end() ? kWords.front() : *word;
                return refuse(use_of(said, pieces_),
                              fmt::format("OpenGL's GLSL has no {}: it is Vulkan's", said),
                              "write a #define, make it a count or a choice of the family, or build for "
                              "--dialect vulkan or gl_spirv");
            }
        const std::string& prologue = pieces_.front()->text;
        const GlslVersion version = version_of(prologue);
        if (version.es || version.number >= 400) return;
        const bool queries_lods = prologue.find("GL_ARB_texture_query_lod ") != std::string::npos;
        const bool indexes_blocks = prologue.find("GL_ARB_gpu_shader5 ") != std::string::npos;
        for (const spirv::Instruction& instruction : module_.instructions) {
            if (instruction.opcode == spv::OpImageQueryLod && !queries_lods)
                return refuse(use_of("textureQueryLod", pieces_), "textureQueryLod() came with GLSL 4.00",
                              "state #version 400, or #extension GL_ARB_texture_query_lod : require");
            if (instruction.opcode == spv::OpAccessChain && !indexes_blocks) check_block_index(instruction);
        }
    }

    void check_block_index(const spirv::Instruction& access) {
        const auto variable = std::ranges::find(module_.variables, access.id(3), &spirv::Variable::id);
        if (variable == module_.variables.end() || variable->storage != spv::StorageClassUniform) return;
        const spirv::Type& type = module_.type(variable->type);
        if (!type.is_array() || module_.integers.contains(access.id(4))) return;
        const std::string block = spirv::type_name(module_, type.element);
        const Place place = module_.place(access.line);
        refuse(place.line > 0 ? Declaration{place, "", false} : declared(block),
               fmt::format(
                   "the array of blocks '{}' is indexed by what is no constant, which came with GLSL 4.00",
                   block),
               "state #version 400, or put an array into one block");
    }

    [[nodiscard]] Declaration declared(const std::string& name) const {
        return declaration_of(name, "", pieces_);
    }

    void check_position() {
        const Part position = spirv::built_in_output(module_, spv::BuiltInPosition);
        if (position.first == Id::none || !usage_.written.contains(position)) {
            const GlslVersion version = version_of(pieces_.front()->text);
            // Drivers refuse to link it before GLSL 1.40, later it is undefined.
            const bool is_refused =
                kind_ == StageKind::vertex && !version.es && version.number < 140 && !is_spirv(dialect_);
            found_.push_back(diagnostic_at(
                {{pieces_.back()->path, 0, 0}, "", false}, is_refused ? Severity::error : Severity::warning,
                fmt::format("the {} stage never writes gl_Position", name_of(kind_)),
                "write it in main(): where the vertex is drawn is undefined"));
        } else if (kind_ != StageKind::geometry && !usage_.always_written.contains(position))
            warn(use_of("gl_Position", pieces_), "some paths through main() do not write gl_Position",
                 "write it on all of them: where the vertex is drawn is undefined");
    }

    /// glslang takes 1 where nothing is stated, OpenGL does not (GLSL 4.50, 4.4.1.4).
    void check_local_size() {
        for (const std::string_view name : {"local_size_x", "local_size_y", "local_size_z", "local_size_x_id",
                                            "local_size_y_id", "local_size_z_id"})
            if (use_of(name, pieces_).place.line > 0) return;
        found_.push_back(
            diagnostic_at({{pieces_.back()->path, 0, 0}, "", false}, Severity::error,
                          "the compute stage does not state the size of its work groups",
                          "write layout(local_size_x = 64) in; with the number of invocations in a group"));
    }

    /// A number that an execution mode gives; 0 where the stage has not that mode.
    [[nodiscard]] std::int64_t mode_value(spv::ExecutionMode mode, std::size_t word = 3) const {
        for (const spirv::Instruction& instruction : module_.instructions)
            if (instruction.opcode == spv::OpExecutionMode && instruction.as<spv::ExecutionMode>(2) == mode)
                return instruction.word(word);
        return 0;
    }

    void at_most(std::int64_t limit, std::int64_t size, const Declaration& at, std::string_view what,
                 std::string_view constant, Severity severity = Severity::error) {
        if (size > guaranteed(dialect_, limit, constant))
            found_.push_back(diagnostic_at(
                at, size > limit ? severity : Severity::warning,
                fmt::format("{}: {}, {}", what, size, guarantee_text(dialect_, size, limit, constant)),
                "state fewer"));
    }

    void check_sizes() {
        if (kind_ == StageKind::geometry)
            at_most(32, mode_value(spv::ExecutionModeInvocations), use_of("invocations", pieces_),
                    "invocations of the geometry stage", "MAX_GEOMETRY_SHADER_INVOCATIONS");
        if (kind_ == StageKind::tess_control)
            at_most(32, mode_value(spv::ExecutionModeOutputVertices), use_of("vertices", pieces_),
                    "vertices of a patch", "MAX_PATCH_VERTICES");
        if (kind_ != StageKind::compute) return;
        std::int64_t group = 1;
        for (const std::size_t word : {3, 4, 5}) group *= mode_value(spv::ExecutionModeLocalSize, word);
        std::int64_t shared = 0;
        Id largest = Id::none;
        std::int64_t most = 0;
        for (const spirv::Variable& variable : module_.variables) {
            if (variable.storage != spv::StorageClassWorkgroup ||
                !(usage_.reads(variable.id) || usage_.writes(variable.id)))
                continue;
            const Extent extent = extent_of(variable.type);
            shared = rounded_up(shared, extent.alignment) + extent.size;
            if (extent.size > most) largest = variable.id;
            most = std::max(most, extent.size);
        }
        const auto check = [&](std::int64_t groups, std::int64_t bytes, std::string_view whose,
                               Severity severity) {
            at_most(groups, group, use_of("local_size_x", pieces_), "invocations of a work group",
                    fmt::format("MAX_COMPUTE_WORK_GROUP_INVOCATIONS{}", whose), severity);
            if (largest != Id::none)
                at_most(bytes, shared, declared(module_.name(largest)), "bytes of shared variables",
                        fmt::format("MAX_COMPUTE_SHARED_MEMORY_SIZE{}", whose), severity);
        };
        check(1024, 32768, "", Severity::error);
        // Most drivers of OpenGL ES have as much as OpenGL guarantees.
        if (version_of(pieces_.front()->text).es && found_.empty())
            check(128, 16384, " of OpenGL ES", Severity::warning);
    }

    /// Bytes of a shared variable, laid out as a storage block would be by std430: so do drivers.
    struct Extent {
        std::int64_t size = 0;
        std::int64_t alignment = 1;
    };
    [[nodiscard]] Extent extent_of(Id id) const {
        constexpr std::int64_t kMost = std::int64_t{1} << 40;  // no sum of these overflows
        const spirv::Type& type = module_.type(id);
        if (type.is_array()) {
            const Extent element = extent_of(type.element);
            const std::int64_t last = type.count > 0 ? std::int64_t{type.count} - 1 : 0;
            const std::int64_t stride = rounded_up(element.size, element.alignment);
            const bool is_huge = stride > 0 && last > kMost / stride;
            return {is_huge ? kMost : last * stride + element.size, element.alignment};
        }
        if (type.members.empty())
            return {std::int64_t{type.value.column_alignment()} * (type.value.columns - 1) +
                        type.value.column_size(),
                    type.value.column_alignment()};
        Extent all;
        for (const Id member : type.members) {
            const Extent extent = extent_of(member);
            all.size = std::min(rounded_up(all.size, extent.alignment) + extent.size, kMost);
            all.alignment = std::max(all.alignment, extent.alignment);
        }
        all.size = rounded_up(all.size, all.alignment);
        return all;
    }

    /// glslang takes any size that is computed from specialisation constants.
    void check_array_sizes() {
        for (const spirv::Instruction& variable : module_.instructions) {
            if (variable.opcode != spv::OpVariable) continue;
            const Id type = module_.type(variable.type).element;
            const Id array = unknown_size_in(type);
            if (array == Id::none) continue;
            std::string name = module_.name(variable.result);
            if (name.empty()) name = spirv::type_name(module_, type);
            const Place place = module_.place(variable.line);
            const spirv::Instruction* const declaration = module_.definition(array);
            const auto size = module_.integers.find(declaration->id(3));
            const std::string what =
                size == module_.integers.end()
                    ? fmt::format("the size of an array in '{}' has no value", name)
                    : fmt::format("the size of an array in '{}' is {}", name, size->second);
            return refuse(place.line > 0 ? Declaration{place, "", false} : declared(name),
                          what + " where specialisation constants stand at their defaults",
                          "state defaults that make it at least 1, divide by none that is 0, and shift by "
                          "fewer bits than there are");
        }
    }

    /// The first array of unknown size that a type is made of.
    [[nodiscard]] Id unknown_size_in(Id id) const {
        if (module_.unknown_sizes.contains(id)) return id;
        const spirv::Type& type = module_.type(id);
        if (type.is_array()) return unknown_size_in(type.element);
        for (const Id member : type.members)
            if (const Id found = unknown_size_in(member); found != Id::none) return found;
        return Id::none;
    }

    /// What a buffer block states as writeonly may not be read, as `+=` does.
    void check_writeonly() {
        for (const spirv::Instruction& load : module_.instructions) {
            const spirv::Instruction* chain =
                load.opcode == spv::OpLoad ? module_.definition(load.id(3)) : nullptr;
            if (chain == nullptr || chain->opcode != spv::OpAccessChain) continue;
            const auto variable = std::ranges::find(module_.variables, chain->id(3), &spirv::Variable::id);
            const auto member = module_.integers.find(chain->id(4));
            if (variable == module_.variables.end() || member == module_.integers.end()) continue;
            const auto index = static_cast<int>(member->second);
            if (!module_.decoration(variable->type, spv::DecorationNonReadable, index)) continue;
            const std::string name = module_.name(variable->type, index);
            return refuse(use_of(name, pieces_), fmt::format("'{}' is writeonly, and is read", name),
                          "take writeonly out of its block, or write it without reading it");
        }
    }

    /// Further streams take points alone (GLSL 4.60, 8.15), and there are four.
    void check_streams() {
        const bool has_points = has_mode(spv::ExecutionModeOutputPoints);
        for (const spirv::Instruction& instruction : module_.instructions) {
            if (instruction.opcode != spv::OpEmitStreamVertex) continue;
            const auto stream = module_.integers.find(instruction.id(1));
            if (stream == module_.integers.end()) continue;
            at_most(4, stream->second + 1, use_of("EmitStreamVertex", pieces_),
                    "streams up to that of EmitStreamVertex()", "MAX_VERTEX_STREAMS");
            if (stream->second != 0 && !has_points)
                return refuse(
                    use_of("EmitStreamVertex", pieces_),
                    fmt::format("stream {} takes points alone, and this stage emits others", stream->second),
                    "state layout(points) out, or emit into stream 0");
        }
    }

    /// MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS: those of all vertices together.
    void check_vertices() {
        constexpr std::int64_t kGuaranteed = 1024;
        const std::int64_t vertices = mode_value(spv::ExecutionModeOutputVertices);
        const Part position = spirv::built_in_output(module_, spv::BuiltInPosition);
        std::int64_t components = position.first != Id::none && usage_.written.contains(position) ? 4 : 0;
        for (const Variable& output : interface_.outputs)
            if (!output.usage.unused)
                components += std::int64_t{1} * glsl_type(output.type).value_or(GlslType{}).components() *
                              element_count(output.array);
        if (vertices * components > kGuaranteed)
            refuse(use_of("max_vertices", pieces_),
                   fmt::format("{} vertices of {} components each are {}, {}", vertices, components,
                               vertices * components,
                               guarantee_text(dialect_, vertices * components, kGuaranteed,
                                              "MAX_GEOMETRY_TOTAL_OUTPUT_COMPONENTS")),
                   "emit fewer vertices, or write fewer components with each");
    }

    /// glslang sizes gl_SampleMask by its use, and gl_FragData for all that any driver has.
    void check_built_in_arrays() {
        struct Limit {
            std::string_view name;
            std::int64_t elements;
            std::string_view constant;
        };
        constexpr std::array<Limit, 3> kLimits = {{{"gl_SampleMask", 1, "MAX_SAMPLE_MASK_WORDS"},
                                                   {"gl_SampleMaskIn", 1, "MAX_SAMPLE_MASK_WORDS"},
                                                   {"gl_FragData", 8, "MAX_DRAW_BUFFERS"}}};
        for (const spirv::Instruction& access : module_.instructions) {
            const auto index = module_.integers.find(access.id(4));
            if (access.opcode != spv::OpAccessChain || index == module_.integers.end()) continue;
            const auto limit = std::ranges::find(kLimits, module_.name(access.id(3)), &Limit::name);
            if (limit != kLimits.end())
                at_most(limit->elements, index->second + 1, use_of(limit->name, pieces_),
                        fmt::format("elements of {} up to the last", limit->name), limit->constant);
        }
    }

    void check_output(const spirv::Variable& variable) {
        const std::string name = module_.name(variable.id);
        const bool is_written = usage_.writes(variable.id);
        if (is_built_in(module_, variable) && !is_written) return;  // OpenGL's own value stands
        const std::string help = "give it a value at the start of main(): it is undefined there";
        if (!is_written)
            warn(declared(name),
                 fmt::format("the fragment stage never writes its output '{}'", name_in_files(name)),
                 "write it in main(), or take the declaration out");
        else if (!is_always_written(variable.id))
            warn(is_built_in(module_, variable) ? use_of(name, pieces_) : declared(name),
                 fmt::format("some paths through main() do not write '{}'", name_in_files(name)), help);
    }

    [[nodiscard]] bool is_always_written(Id variable) const {
        return std::ranges::any_of(usage_.always_written,
                                   [&](const Part& part) { return part.first == variable; });
    }

    [[nodiscard]] bool has_mode(auto... modes) const {
        for (const spirv::Instruction& instruction : module_.instructions) {
            if (instruction.opcode == spv::OpFunction) break;
            if (instruction.opcode != spv::OpExecutionMode) continue;
            const auto mode = instruction.as<spv::ExecutionMode>(2);
            if (((mode == modes) || ...)) return true;
        }
        return false;
    }

    void check_early_tests() {
        if (!has_mode(spv::ExecutionModeEarlyFragmentTests)) return;
        const std::string early = declared("early_fragment_tests").text();
        const Part depth = spirv::built_in_output(module_, spv::BuiltInFragDepth);
        if (depth.first != Id::none && usage_.written.contains(depth))
            warn(use_of("gl_FragDepth", pieces_),
                 fmt::format("what is written to gl_FragDepth is ignored: {} states early_fragment_tests",
                             early),
                 "drop one of the two");
        if (usage_.discards)
            warn(
                use_of("discard", pieces_),
                fmt::format("discard comes too late for the depth buffer: {} states early_fragment_tests, so "
                            "the depth of a discarded fragment is stored",
                            early),
                "drop one of the two");
    }

    const spirv::Module& module_;
    const spirv::Usage& usage_;
    const Interface& interface_;
    const std::vector<const Piece*>& pieces_;
    Dialect dialect_;
    StageKind kind_;
    Diagnostics found_;
};

}  // namespace

Diagnostics check_stage(const spirv::Module& module, const spirv::Usage& usage, const Interface& interface,
                        const std::vector<const Piece*>& pieces, bool places_vertices, Dialect dialect) {
    return StageCheck(module, usage, interface, pieces, dialect).run(places_vertices);
}

}  // namespace gobo
