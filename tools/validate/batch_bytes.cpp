// A BatchResult as bytes.
#include "core/bytes.hpp"
#include "validate/batch.hpp"

namespace gobo {

static void fields(auto& archive, OneOf<Usage> auto& value) {
    auto& [unused, anonymous, precision, access, stated] = value;
    archive(unused, anonymous, precision, access, stated);
}
static void fields(auto& archive, OneOf<Interpolation> auto& value) {
    auto& [flat, noperspective, centroid, sample, invariant] = value;
    archive(flat, noperspective, centroid, sample, invariant);
}
static void fields(auto& archive, OneOf<Member> auto& value) {
    auto& [name, type, offset, array, array_stride, matrix_stride, row_major, members, usage] = value;
    archive(name, type, offset, array, array_stride, matrix_stride, row_major, members, usage);
}
static void fields(auto& archive, OneOf<Block> auto& value) {
    auto& [name, binding, size, stages, members, usage, set] = value;
    archive(name, binding, size, stages, members, usage, set);
}
static void fields(auto& archive, OneOf<Uniform> auto& value) {
    auto& [name, type, location, array, members, stages, usage, counter_binding, counter_offset] = value;
    archive(name, type, location, array, members, stages, usage, counter_binding, counter_offset);
}
static void fields(auto& archive, OneOf<Sampler> auto& value) {
    auto& [name, type, binding, array, stages, usage, set, location] = value;
    archive(name, type, binding, array, stages, usage, set, location);
}
static void fields(auto& archive, OneOf<Variable> auto& value) {
    auto& [name, type, location, array, component, interpolation, per_vertex, patch, usage, whole] = value;
    archive(name, type, location, array, component, interpolation, per_vertex, patch, usage, whole);
}
static void fields(auto& archive, OneOf<SpecializationConstant> auto& value) {
    auto& [name, type, id, bits] = value;
    archive(name, type, id, bits);
}
static void fields(auto& archive, OneOf<Interface> auto& value) {
    auto& [stages, blocks, storage_blocks, uniforms, samplers, inputs, outputs, push_constants, constants] =
        value;
    archive(stages, blocks, storage_blocks, uniforms, samplers, inputs, outputs, push_constants, constants);
}
static void fields(auto& archive, OneOf<ValidatedStage> auto& value) {
    auto& [spirv, hash, interface, diagnostics] = value;
    archive(spirv, hash, interface, diagnostics);
}
static void fields(auto& archive, OneOf<BatchResult::OfStage> auto& value) {
    auto& [stage, is_fine, diagnostics, validated] = value;
    archive(stage, is_fine, diagnostics, validated);
}
static void fields(auto& archive, OneOf<BatchResult::OfProgram> auto& value) {
    auto& [program, diagnostics] = value;
    archive(program, diagnostics);
}
static void fields(auto& archive, OneOf<BatchResult> auto& value) {
    auto& [stages, programs] = value;
    archive(stages, programs);
}

std::string bytes_of(const BatchResult& result) {
    return to_bytes(result);
}

std::optional<BatchResult> result_of(std::string_view bytes) {
    return from_bytes<BatchResult>(bytes);
}

}  // namespace gobo
