// Texture functions: each active lane asks the caller's image.
#include <cmath>

#include "lab/evaluate/image_call.hpp"
#include "lab/evaluate/loops.hpp"
#include "lab/evaluate/quads.hpp"

namespace gobo::evaluate {
namespace {

using Call = ImageCall;

/// Fills the request of one lane from the operands that the call has.
template <class T>
class RequestReader {
  public:
    RequestReader(const std::uint32_t* words, Machine<T>& machine, std::size_t lane)
        : words_(words), machine_(machine), lane_(lane) {}

    ImageRequest read() {
        ImageRequest request;
        request.what = static_cast<ImageRequest::What>(words_[Call::what]);
        request.dimensions = static_cast<int>(words_[Call::dimensions]);
        request.arrayed = words_[Call::arrayed] != 0;
        request.invocation = machine_.first_invocation + lane_;
        if (words_[Call::coordinates] != 0) read_coordinates(request);
        if (words_[Call::reference] != 0) {
            request.compares = true;
            request.reference = real(Call::reference, 0) / divisor();
        }
        read_level(request);
        for (std::uint32_t axis = 0; axis < words_[Call::dimensions] && words_[Call::offset] != 0; ++axis)
            request.offset[axis] = whole(Call::offset, axis);
        if (words_[Call::sample] != 0) request.sample = whole(Call::sample, 0);
        if (words_[Call::component] != 0) request.component = whole(Call::component, 0);
        return request;
    }

  private:
    [[nodiscard]] const T* row(Call::Word word, std::uint32_t component) const {
        return machine_.reals(words_[word] - 1 + component);
    }
    [[nodiscard]] double real(Call::Word word, std::uint32_t component) const {
        return static_cast<double>(row(word, component)[lane_]);
    }
    [[nodiscard]] int whole(Call::Word word, std::uint32_t component) const {
        return to_signed(machine_.wholes(words_[word] - 1 + component)[lane_]);
    }
    [[nodiscard]] double divisor() const {
        return words_[Call::projective] != 0 ? real(Call::projective, 0) : 1.0;
    }

    void read_coordinates(ImageRequest& request) const {
        const bool are_whole = words_[Call::whole_coordinates] != 0;
        const std::uint32_t count = words_[Call::dimensions] + words_[Call::arrayed];
        for (std::uint32_t axis = 0; axis < count; ++axis)
            request.coordinates[axis] =
                are_whole ? whole(Call::coordinates, axis) : real(Call::coordinates, axis) / divisor();
    }

    void read_level(ImageRequest& request) const {
        if (words_[Call::bias] != 0) request.bias = real(Call::bias, 0);
        if (words_[Call::lod] != 0) {
            request.has_lod = true;
            request.lod = words_[Call::lod_is_whole] != 0 ? whole(Call::lod, 0) : real(Call::lod, 0);
        }
        for (std::uint32_t axis = 0; axis < words_[Call::dimensions]; ++axis) {
            if (words_[Call::gradient_x] != 0) {
                request.dx[axis] = real(Call::gradient_x, axis);
                request.dy[axis] = real(Call::gradient_y, axis);
            } else if (words_[Call::implicit] != 0) {
                request.dx[axis] = across_quad(axis, lane_ & ~std::size_t{1}, 1);
                request.dy[axis] = across_quad(axis, lane_ & ~std::size_t{2}, 2);
            }
        }
    }

    /// The change of a (projected) coordinate between two lanes of the quad.
    [[nodiscard]] double across_quad(std::uint32_t axis, std::size_t from, std::size_t step) const {
        const T* values = row(Call::coordinates, axis);
        if (words_[Call::projective] == 0) return static_cast<double>(values[from + step] - values[from]);
        const T* divisors = row(Call::projective, 0);
        return static_cast<double>(values[from + step] / divisors[from + step] -
                                   values[from] / divisors[from]);
    }

    const std::uint32_t* words_;
    Machine<T>& machine_;
    std::size_t lane_;
};

template <class T>
void ask_image(const Operation& operation, Machine<T>& machine) {
    const std::uint32_t* words = machine.words(operation);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        if (!machine.is_active(lane) || (machine.real >> lane & 1U) == 0) continue;
        const auto index = static_cast<std::size_t>(machine.wholes(words[Call::image] - 1)[lane]);
        const Image* image = machine.image(index);
        if (image == nullptr) return;
        const std::array<double, 4> texel = (*image)(RequestReader<T>(words, machine, lane).read());
        for (std::uint32_t component = 0; component < operation.count; ++component) {
            if (words[Call::whole_result] != 0)
                machine.wholes(operation.result + component)[lane] =
                    to_signed(static_cast<std::int64_t>(texel[component]));
            else
                machine.reals(operation.result + component)[lane] = static_cast<T>(texel[component]);
        }
    }
}

constexpr Execution kAsk{&ask_image<float>, &ask_image<double>};

constexpr Row kRows[] = {
    {spv::OpImageSampleImplicitLod, "ImageSampleImplicitLod", Kind::image, "", kAsk},
    {spv::OpImageSampleExplicitLod, "ImageSampleExplicitLod", Kind::image, "", kAsk},
    {spv::OpImageSampleDrefImplicitLod, "ImageSampleDrefImplicitLod", Kind::image, "", kAsk},
    {spv::OpImageSampleDrefExplicitLod, "ImageSampleDrefExplicitLod", Kind::image, "", kAsk},
    {spv::OpImageSampleProjImplicitLod, "ImageSampleProjImplicitLod", Kind::image, "", kAsk},
    {spv::OpImageSampleProjExplicitLod, "ImageSampleProjExplicitLod", Kind::image, "", kAsk},
    {spv::OpImageSampleProjDrefImplicitLod, "ImageSampleProjDrefImplicitLod", Kind::image, "", kAsk},
    {spv::OpImageSampleProjDrefExplicitLod, "ImageSampleProjDrefExplicitLod", Kind::image, "", kAsk},
    {spv::OpImageFetch, "ImageFetch", Kind::image, "", kAsk},
    {spv::OpImageGather, "ImageGather", Kind::image, "", kAsk},
    {spv::OpImageDrefGather, "ImageDrefGather", Kind::image, "", kAsk},
    {spv::OpImageQuerySizeLod, "ImageQuerySizeLod", Kind::image, "", kAsk},
    {spv::OpImageQuerySize, "ImageQuerySize", Kind::image, "", kAsk},
    {spv::OpImageQueryLevels, "ImageQueryLevels", Kind::image, "", kAsk},
    {spv::OpImageQueryLod, "ImageQueryLod", Kind::image, "", kAsk},
};

}  // namespace

std::span<const Row> image_rows() {
    return kRows;
}

}  // namespace gobo::evaluate
