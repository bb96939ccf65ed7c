// A BatchResult as bytes.
#include "core/bytes.hpp"
#include "validate/batch.hpp"

namespace gobo {

GOBO_FIELDS(Usage, unused, anonymous, precision, access, stated)
GOBO_FIELDS(Interpolation, flat, noperspective, centroid, sample, invariant)
GOBO_FIELDS(Member, name, type, offset, array, array_stride, matrix_stride, row_major, members, usage)
GOBO_FIELDS(Block, name, binding, size, stages, members, usage, set)
GOBO_FIELDS(Uniform, name, type, location, array, members, stages, usage, counter_binding, counter_offset)
GOBO_FIELDS(Sampler, name, type, binding, array, stages, usage, set, location)
GOBO_FIELDS(Variable, name, type, location, array, component, interpolation, per_vertex, patch, usage, whole)
GOBO_FIELDS(SpecializationConstant, name, type, id, bits)
GOBO_FIELDS(Interface, stages, blocks, storage_blocks, uniforms, samplers, inputs, outputs, push_constants,
            constants)
GOBO_FIELDS(ValidatedStage, spirv, hash, interface, diagnostics)
GOBO_FIELDS(BatchResult::OfStage, stage, is_fine, diagnostics, validated)
GOBO_FIELDS(BatchResult::OfProgram, program, diagnostics)
GOBO_FIELDS(BatchResult, stages, programs)

std::string bytes_of(const BatchResult& result) {
    return to_bytes(result);
}

std::optional<BatchResult> result_of(std::string_view bytes) {
    return from_bytes<BatchResult>(bytes);
}

}  // namespace gobo
