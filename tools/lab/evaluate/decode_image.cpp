// Texture functions: which operand of which instruction means what.
#include "lab/evaluate/decoder.hpp"
#include "lab/evaluate/evaluate.hpp"
#include "lab/evaluate/image_call.hpp"

namespace gobo::evaluate {
namespace {

using What = ImageRequest::What;

/// How an image instruction is laid out.
struct ImageForm {
    spv::Op opcode;
    What what;
    bool implicit;         ///< the level of detail follows from the quad
    bool projects;         ///< the coordinate after the last is a divisor
    bool compares;         ///< word 5 is the reference
    bool has_coordinates;  ///< word 4
    std::size_t operands;  ///< word of the image operands mask; 0 where there is none
};

constexpr ImageForm kForms[] = {
    {spv::OpImageSampleImplicitLod, What::sample, true, false, false, true, 5},
    {spv::OpImageSampleExplicitLod, What::sample, false, false, false, true, 5},
    {spv::OpImageSampleDrefImplicitLod, What::sample, true, false, true, true, 6},
    {spv::OpImageSampleDrefExplicitLod, What::sample, false, false, true, true, 6},
    {spv::OpImageSampleProjImplicitLod, What::sample, true, true, false, true, 5},
    {spv::OpImageSampleProjExplicitLod, What::sample, false, true, false, true, 5},
    {spv::OpImageSampleProjDrefImplicitLod, What::sample, true, true, true, true, 6},
    {spv::OpImageSampleProjDrefExplicitLod, What::sample, false, true, true, true, 6},
    {spv::OpImageFetch, What::fetch, false, false, false, true, 5},
    {spv::OpImageGather, What::gather, false, false, false, true, 6},
    {spv::OpImageDrefGather, What::gather, false, false, true, true, 6},
    {spv::OpImageQuerySizeLod, What::size, false, false, false, false, 0},
    {spv::OpImageQuerySize, What::size, false, false, false, false, 0},
    {spv::OpImageQueryLevels, What::levels, false, false, false, false, 0},
    {spv::OpImageQueryLod, What::lod, true, false, false, true, 0},
};

const ImageForm* form_of(spv::Op opcode) {
    for (const ImageForm& form : kForms)
        if (form.opcode == opcode) return &form;
    return nullptr;
}

/// Coordinates of an image without its layer.
std::uint32_t dimensions_of(const ImageType& image) {
    switch (image.dimension) {
        case spv::Dim1D:
        case spv::DimBuffer:
            return 1;
        case spv::Dim3D:
        case spv::DimCube:
            return 3;
        default:
            return 2;
    }
}

}  // namespace

/// False where the instruction has nothing to do with images.
bool Decoder::decode_image(const Instruction& instruction) {
    if (instruction.opcode == spv::OpImage) {
        share_or_copy(instruction, value(instruction, instruction.word(3)));
        return true;
    }
    const ImageForm* form = form_of(instruction.opcode);
    if (form == nullptr) return false;
    std::vector<Value> operands{value(instruction, instruction.word(3))};
    const Type& type = types_[operands[0].type];
    const Type& result = types_[instruction.type];
    if (type.shape != Type::Shape::image || result.slots == 0 || result.slots > 4) {
        report(instruction, opcode_name(instruction.opcode) + " has operands of the wrong types");
        return true;
    }
    ImageCall call;
    const auto set = [&](ImageCall::Word word, std::size_t at, std::uint32_t component = 0) {
        operands.push_back(value(instruction, instruction.word(at)));
        call.words[word] = operands.back().slot + component + 1;
    };
    call.words[ImageCall::what] = static_cast<std::uint32_t>(form->what);
    call.words[ImageCall::image] = operands[0].slot + 1;
    call.words[ImageCall::dimensions] = dimensions_of(type.image);
    call.words[ImageCall::arrayed] = type.image.arrayed && form->what != What::lod ? 1 : 0;
    call.words[ImageCall::implicit] = form->implicit ? 1 : 0;
    call.words[ImageCall::whole_result] = result.scalar == Scalar::real ? 0 : 1;
    std::uint32_t needed = call.words[ImageCall::dimensions] + call.words[ImageCall::arrayed];
    if (form->has_coordinates) {
        set(ImageCall::coordinates, 4);
        call.words[ImageCall::whole_coordinates] =
            types_[operands.back().type].scalar == Scalar::real ? 0 : 1;
        const std::uint32_t given = types_[operands.back().type].slots;
        if (form->projects) call.words[ImageCall::projective] = operands.back().slot + needed++ + 1;
        if (given < needed) report(instruction, "a texture function has too few coordinates");
    }
    if (form->compares)
        set(ImageCall::reference, 5);
    else if (form->what == What::gather)
        set(ImageCall::component, 5);
    if (instruction.opcode == spv::OpImageQuerySizeLod) {
        set(ImageCall::lod, 4);
        call.words[ImageCall::lod_is_whole] = 1;
    }
    if (form->operands != 0) read_image_operands(instruction, form->operands, call, operands);
    emit(instruction.opcode, instruction, result.slots, define(instruction), operands,
         {call.words.begin(), call.words.end()});
    return true;
}

/// The optional operands after the mask, in the order of its bits.
void Decoder::read_image_operands(const Instruction& instruction, std::size_t at, ImageCall& call,
                                  std::vector<Value>& operands) {
    const std::uint32_t mask = instruction.word(at);
    std::size_t next = at + 1;
    const std::uint32_t dimensions = call.words[ImageCall::dimensions];
    const auto take = [&](std::uint32_t bit, ImageCall::Word word, std::uint32_t components) {
        if ((mask & bit) == 0) return;
        operands.push_back(value(instruction, instruction.word(next++)));
        call.words[word] = operands.back().slot + 1;
        if (types_[operands.back().type].slots < components)
            report(instruction, "a texture function has operands of the wrong types");
    };
    take(spv::ImageOperandsBiasMask, ImageCall::bias, 1);
    take(spv::ImageOperandsLodMask, ImageCall::lod, 1);
    if (call.words[ImageCall::lod] != 0 && types_[operands.back().type].scalar != Scalar::real)
        call.words[ImageCall::lod_is_whole] = 1;
    take(spv::ImageOperandsGradMask, ImageCall::gradient_x, dimensions);
    take(spv::ImageOperandsGradMask, ImageCall::gradient_y, dimensions);
    take(spv::ImageOperandsConstOffsetMask, ImageCall::offset, dimensions);
    take(spv::ImageOperandsOffsetMask, ImageCall::offset, dimensions);
    const std::uint32_t known = spv::ImageOperandsBiasMask | spv::ImageOperandsLodMask |
                                spv::ImageOperandsGradMask | spv::ImageOperandsConstOffsetMask |
                                spv::ImageOperandsOffsetMask | spv::ImageOperandsSampleMask;
    take(spv::ImageOperandsSampleMask, ImageCall::sample, 1);
    if ((mask & ~known) != 0)
        report(instruction, "the evaluator does not know an operand of this texture function");
}

}  // namespace gobo::evaluate
