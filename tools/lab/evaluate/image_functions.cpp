// Texture functions: which operand of which instruction means what, and how each active lane asks the
// caller's image.
#include <algorithm>
#include <bit>

#include "lab/evaluate/decoder.hpp"
#include "lab/evaluate/image_call.hpp"
#include "lab/evaluate/rows.hpp"

namespace gobo::evaluate {

using What = ImageRequest::What;

namespace {

/// How an image instruction is laid out.
struct ImageForm {
    std::uint32_t code;
    std::string_view name;
    What what;
    bool is_implicit;      ///< the level of detail follows from the quad
    bool projects;         ///< the coordinate after the last is a divisor
    bool compares;         ///< word 5 is the reference
    bool has_coordinates;  ///< word 4
    std::size_t operands;  ///< word of the image operands mask; 0 where there is none
};

constexpr ImageForm kForms[] = {
    {GOBO_CORE(ImageSampleImplicitLod), What::sample, true, false, false, true, 5},
    {GOBO_CORE(ImageSampleExplicitLod), What::sample, false, false, false, true, 5},
    {GOBO_CORE(ImageSampleDrefImplicitLod), What::sample, true, false, true, true, 6},
    {GOBO_CORE(ImageSampleDrefExplicitLod), What::sample, false, false, true, true, 6},
    {GOBO_CORE(ImageSampleProjImplicitLod), What::sample, true, true, false, true, 5},
    {GOBO_CORE(ImageSampleProjExplicitLod), What::sample, false, true, false, true, 5},
    {GOBO_CORE(ImageSampleProjDrefImplicitLod), What::sample, true, true, true, true, 6},
    {GOBO_CORE(ImageSampleProjDrefExplicitLod), What::sample, false, true, true, true, 6},
    {GOBO_CORE(ImageFetch), What::fetch, false, false, false, true, 5},
    {GOBO_CORE(ImageRead), What::fetch, false, false, false, true, 5},
    {GOBO_CORE(ImageGather), What::gather, false, false, false, true, 6},
    {GOBO_CORE(ImageDrefGather), What::gather, false, false, true, true, 6},
    {GOBO_CORE(ImageQuerySizeLod), What::size, false, false, false, false, 0},
    {GOBO_CORE(ImageQuerySize), What::size, false, false, false, false, 0},
    {GOBO_CORE(ImageQueryLevels), What::levels, false, false, false, false, 0},
    {GOBO_CORE(ImageQueryLod), What::lod, true, false, false, true, 0},
};

}  // namespace

/// False where the instruction has nothing to do with images.
bool Decoder::decode_image(const Instruction& instruction) {
    const auto* form = std::ranges::find(kForms, std::uint32_t{instruction.opcode}, &ImageForm::code);
    if (form == std::end(kForms)) return false;
    Values operands{value(instruction, 3)};
    const Type& sampled = type(operands[0]);
    const Type& result = type(instruction.type);
    if (!sampled.is_image() || result.scalars == 0 || result.scalars > 4) {
        report_types(instruction);
        return true;
    }
    ImageCall call;
    const auto set = [&](std::uint32_t& slot, std::size_t at) {
        operands.push_back(value(instruction, at));
        slot = operands.back().slot + 1;
    };
    call.what = static_cast<std::uint32_t>(form->what);
    call.image = operands[0].slot + 1;
    call.dimensions = dimensions_of(sampled.image);
    call.is_arrayed = sampled.image.arrayed && form->what != What::lod ? 1 : 0;
    call.is_implicit = form->is_implicit ? 1 : 0;
    call.has_int_result = is_float(result.value.scalar) ? 0 : 1;
    call.is_storage = instruction.opcode == spv::OpImageRead ? 1 : 0;
    std::uint32_t needed = call.dimensions + call.is_arrayed;
    if (form->has_coordinates) {
        set(call.coordinates, 4);
        const Type& given = type(operands.back());
        call.has_int_coordinates = is_float(given.value.scalar) ? 0 : 1;
        if (form->projects) call.divisor = operands.back().slot + needed++ + 1;
        if (given.scalars < needed) report(instruction, "a texture function has too few coordinates");
    }
    if (form->compares)
        set(call.reference, 5);
    else if (form->what == What::gather)
        set(call.component, 5);
    if (instruction.opcode == spv::OpImageQuerySizeLod) {
        set(call.lod, 4);
        call.has_int_level = 1;
    }
    if (form->operands != 0) read_image_operands(instruction, form->operands, call, operands);
    const auto words = std::bit_cast<ImageWords>(call);
    emit(instruction.opcode, instruction, result.scalars, define(instruction), operands,
         {words.begin(), words.end()});
    return true;
}

/// A texel of an image without a sampler; coordinates of a cube are its texel and its face.
ImageCall Decoder::call_of_texel(const Instruction& instruction, const Texel& texel) {
    const Type& image = type(texel.image);
    const Type& coordinates = type(texel.coordinates);
    ImageCall call;
    call.what = static_cast<std::uint32_t>(What::fetch);
    call.image = texel.image.slot + 1;
    call.dimensions = dimensions_of(image.image);
    call.is_arrayed = image.image.arrayed ? 1 : 0;
    call.is_storage = 1;
    call.has_int_result = 1;
    call.has_int_coordinates = 1;
    call.coordinates = texel.coordinates.slot + 1;
    if (texel.sample.type != Id::none && image.image.multisampled) call.sample = texel.sample.slot + 1;
    if (coordinates.scalars < call.dimensions + call.is_arrayed || !is_integer(coordinates.value.scalar))
        report_types(instruction);
    return call;
}

/// The optional operands after the mask, in the order of its bits.
void Decoder::read_image_operands(const Instruction& instruction, std::size_t at, ImageCall& call,
                                  Values& operands) {
    const std::uint32_t mask = instruction.word(at);
    std::size_t next = at + 1;
    std::uint32_t known = 0;
    const auto take = [&](std::uint32_t bit, std::uint32_t& slot, std::uint32_t components) {
        known |= bit;
        if ((mask & bit) == 0) return;
        operands.push_back(value(instruction, next++));
        slot = operands.back().slot + 1;
        if (type(operands.back()).scalars < components)
            report(instruction, "a texture function has operands of the wrong types");
    };
    take(spv::ImageOperandsBiasMask, call.bias, 1);
    take(spv::ImageOperandsLodMask, call.lod, 1);
    if (call.lod != 0) call.has_int_level = is_float(type(operands.back()).value.scalar) ? 0 : 1;
    take(spv::ImageOperandsGradMask, call.gradient_x, call.dimensions);
    take(spv::ImageOperandsGradMask, call.gradient_y, call.dimensions);
    take(spv::ImageOperandsConstOffsetMask, call.offset, call.dimensions);
    take(spv::ImageOperandsOffsetMask, call.offset, call.dimensions);
    take(spv::ImageOperandsSampleMask, call.sample, 1);
    if ((mask & ~known) != 0)
        report(instruction, "the evaluator does not know an operand of this texture function");
}

namespace {

/// The request of one lane, from the operands that the call has.
template <class T>
ImageRequest request_of(const ImageCall& call, Registers<T>& registers, std::size_t lane) {
    const auto number = [&](std::uint32_t slot, std::uint32_t component = 0) {
        return static_cast<double>(registers.floats(slot - 1 + component)[lane]);
    };
    const auto integer = [&](std::uint32_t slot, std::uint32_t component = 0) {
        return to_signed(registers.ints(slot - 1 + component)[lane]);
    };
    // The change of a (projected) coordinate between two lanes of the quad.
    const auto across_quad = [&](std::uint32_t axis, std::size_t from, std::size_t step) {
        const T* values = registers.floats(call.coordinates - 1 + axis);
        if (call.divisor == 0) return static_cast<double>(values[from + step] - values[from]);
        const T* divisors = registers.floats(call.divisor - 1);
        return static_cast<double>(values[from + step] / divisors[from + step] -
                                   values[from] / divisors[from]);
    };
    ImageRequest request;
    request.what = static_cast<What>(call.what);
    request.dimensions = static_cast<int>(call.dimensions);
    request.arrayed = call.is_arrayed != 0;
    request.invocation = registers.first_invocation + lane;
    request.compares = call.reference != 0;
    request.has_lod = call.lod != 0;
    const double divisor = call.divisor != 0 ? number(call.divisor) : 1.0;
    for (std::uint32_t axis = 0; axis < call.dimensions + call.is_arrayed && call.coordinates != 0; ++axis)
        request.coordinates[axis] = call.has_int_coordinates != 0 ? integer(call.coordinates, axis)
                                                                  : number(call.coordinates, axis) / divisor;
    if (request.compares) request.reference = number(call.reference) / divisor;
    if (call.bias != 0) request.bias = number(call.bias);
    if (request.has_lod) request.lod = call.has_int_level != 0 ? integer(call.lod) : number(call.lod);
    for (std::uint32_t axis = 0; axis < call.dimensions; ++axis) {
        if (call.gradient_x != 0) {
            request.dx[axis] = number(call.gradient_x, axis);
            request.dy[axis] = number(call.gradient_y, axis);
        } else if (call.is_implicit != 0) {
            request.dx[axis] = across_quad(axis, lane & ~std::size_t{1}, 1);
            request.dy[axis] = across_quad(axis, lane & ~std::size_t{2}, 2);
        }
        if (call.offset != 0) request.offset[axis] = integer(call.offset, axis);
    }
    if (call.sample != 0) request.sample = integer(call.sample);
    if (call.component != 0) request.component = integer(call.component);
    return request;
}

/// Which texel of an image a request without a sampler is about.
template <class T>
TexelPlace place_of(const ImageCall& call, const ImageRequest& request, Registers<T>& registers,
                    std::size_t lane) {
    TexelPlace place{request.invocation, static_cast<std::size_t>(registers.ints(call.image - 1)[lane])};
    for (std::size_t axis = 0; axis < call.dimensions + call.is_arrayed; ++axis)
        place.coordinates[axis] = static_cast<int>(request.coordinates[axis]);
    place.sample = request.sample;
    return place;
}

template <class T>
ImageCall call_of(const Operation& operation, const Registers<T>& registers) {
    ImageWords words;
    std::copy_n(registers.words(operation), words.size(), words.begin());
    return std::bit_cast<ImageCall>(words);
}

constexpr Execution kAsk = kRun<[]<class T>(const Operation& operation, Registers<T>& registers) {
    const ImageCall call = call_of(operation, registers);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (!has_lane(registers.active() & registers.callers_lanes, lane)) continue;
        const ImageRequest request = request_of(call, registers, lane);
        std::optional<std::array<double, 4>> texel;
        if (call.is_storage != 0) texel = registers.known_texel(place_of(call, request, registers, lane));
        if (!texel) {
            const Image* image =
                registers.image(static_cast<std::size_t>(registers.ints(call.image - 1)[lane]));
            if (image == nullptr) return;
            texel = (*image)(request);
        }
        for (std::uint32_t component = 0; component < operation.count; ++component) {
            if (call.has_int_result != 0)
                registers.ints(operation.result + component)[lane] =
                    to_signed(static_cast<std::int64_t>((*texel)[component]));
            else
                registers.floats(operation.result + component)[lane] = static_cast<T>((*texel)[component]);
        }
    }
}>;

constexpr Execution kWrite = kRun<[]<class T>(const Operation& operation, Registers<T>& registers) {
    const ImageCall call = call_of(operation, registers);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (!has_lane(registers.active() & registers.callers_lanes, lane)) continue;
        const ImageRequest request = request_of(call, registers, lane);
        std::array<double, 4> texel{};
        for (std::uint32_t component = 0; component < std::min(call.texel_components, 4U); ++component) {
            const std::uint32_t slot = call.texel - 1 + component;
            texel[component] = call.has_int_result != 0
                                   ? static_cast<double>(to_signed(registers.ints(slot)[lane]))
                                   : static_cast<double>(registers.floats(slot)[lane]);
        }
        registers.write(place_of(call, request, registers, lane), texel);
    }
}>;

constexpr auto kRows = [] {
    std::array<Row, std::size(kForms) + 1> rows{};
    rows.back() = {GOBO_CORE(ImageWrite), Kind::image, "", kWrite};
    for (std::size_t i = 0; i < std::size(kForms); ++i)
        rows[i] = {kForms[i].code, kForms[i].name, Kind::image, "", kAsk};
    return rows;
}();

}  // namespace

constinit const std::span<const Row> kImageRows = kRows;

bool needs_quads(const Program& program) {
    return program.is_fragment && std::ranges::any_of(program.operations, [&](const Operation& operation) {
               const Kind kind = row_of(operation).kind;
               return kind == Kind::derivative ||
                      (kind == Kind::image && image_call_of(program, operation).is_implicit != 0);
           });
}

}  // namespace gobo::evaluate
