#include "lab/sanitize/image_rules.hpp"

#include <cmath>

#include "lab/evaluate/image_call.hpp"
#include "lab/evaluate/images.hpp"
#include "lab/evaluate/instruction_table.hpp"

namespace gobo::sanitize {
namespace {

using evaluate::ImageCall;
using evaluate::kLanes;
using Step = evaluate::Step<float>;
using What = evaluate::ImageRequest::What;

/// A slot as the call holds it.
const float* floats(const Step& step, std::uint32_t slot, std::uint32_t component = 0) {
    return step.rows + (std::size_t{slot} - 1 + component) * kLanes;
}
const std::int32_t* ints(const Step& step, std::uint32_t slot, std::uint32_t component = 0) {
    return reinterpret_cast<const std::int32_t*>(floats(step, slot, component));
}

template <class Test>
Lanes lanes_where(const Step& step, const Test& test) {
    Lanes lanes = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane)
        if ((step.lanes >> lane & 1U) != 0 && test(lane)) lanes |= Lanes{1} << lane;
    return lanes;
}

/// The pixels that run the step in quads of which others, not discarded or only those, do not.
Lanes parted(const Step& step, Lanes callers, bool by_discard) {
    Lanes lanes = 0;
    for (std::size_t first = 0; first < kLanes; first += 4) {
        const Lanes quad = Lanes{15} << first;
        if ((callers & quad) != quad) continue;  // no quad at all
        const Lanes running = step.lanes & quad;
        const Lanes others = quad & ~step.lanes & ~step.discarded;
        const bool is_parted = by_discard ? others == 0 && running != quad : others != 0;
        if (running != 0 && is_parted) lanes |= running;
    }
    return lanes;
}

/// One texture function.
class ImageStep {
  public:
    ImageStep(const Step& step, const evaluate::Invocations& invocations)
        : step_(step),
          invocations_(invocations),
          call_(evaluate::image_call_of(step.program, step.program.operations[step.operation])) {}

    [[nodiscard]] bool is_implicit() const { return call_.is_implicit != 0; }
    [[nodiscard]] bool is_shadow() const { return call_.reference != 0; }
    /// Of a texture: without a sampler there is nothing undefined outside of an image.
    [[nodiscard]] bool is_fetch() const {
        return static_cast<What>(call_.what) == What::fetch && call_.is_storage == 0;
    }

    [[nodiscard]] Lanes projects_from_behind() const {
        if (call_.divisor == 0) return 0;
        const float* const divisor = floats(step_, call_.divisor);
        return lanes_where(step_, [&](std::size_t lane) { return divisor[lane] <= 0; });
    }

    [[nodiscard]] Lanes is_along_nothing() const {
        if (call_.coordinates == 0 || call_.dimensions != 3 || call_.has_int_coordinates != 0) return 0;
        return lanes_where(step_, [&](std::size_t lane) {
            const evaluate::ImagePort* const port = port_of(lane);
            if (port == nullptr || port->type.dimension != spv::DimCube) return false;
            for (std::uint32_t axis = 0; axis < 3; ++axis)
                if (floats(step_, call_.coordinates, axis)[lane] != 0) return false;
            return true;
        });
    }

    [[nodiscard]] Lanes fetches_outside() const {
        return lanes_where(step_, [&](std::size_t lane) {
            if (call_.is_arrayed != 0 && ints(step_, call_.coordinates, call_.dimensions)[lane] < 0)
                return true;
            if (call_.sample != 0 && ints(step_, call_.sample)[lane] < 0) return true;
            const evaluate::TexelPattern* const pattern = pattern_at(lane);
            const int side = pattern == nullptr ? 0 : pattern->side >> std::clamp(level(lane), 0, 30);
            for (std::uint32_t axis = 0; axis < call_.dimensions; ++axis) {
                const int offset = call_.offset == 0 ? 0 : ints(step_, call_.offset, axis)[lane];
                const std::int64_t at = std::int64_t{ints(step_, call_.coordinates, axis)[lane]} + offset;
                if (at < 0 || (pattern != nullptr && pattern->side > 0 && at >= std::max(side, 1)))
                    return true;
            }
            return false;
        });
    }

    /// Of texelFetch() and textureSize(), which take a level as it is.
    [[nodiscard]] Lanes has_no_such_level() const {
        if (call_.has_int_level == 0 || call_.lod == 0) return 0;
        return lanes_where(step_, [&](std::size_t lane) {
            const evaluate::TexelPattern* const pattern = pattern_at(lane);
            const bool is_stated = pattern != nullptr && (pattern->side > 0 || pattern->levels > 0);
            return level(lane) < 0 || (is_stated && level(lane) >= pattern->known_levels());
        });
    }

  private:
    [[nodiscard]] int level(std::size_t lane) const {
        return call_.lod == 0 || call_.has_int_level == 0 ? 0 : ints(step_, call_.lod)[lane];
    }
    [[nodiscard]] const evaluate::ImagePort* port_of(std::size_t lane) const {
        const auto index = static_cast<std::size_t>(ints(step_, call_.image)[lane]);
        return index < step_.program.images.size() ? &step_.program.images[index] : nullptr;
    }
    [[nodiscard]] const evaluate::TexelPattern* pattern_at(std::size_t lane) const {
        const evaluate::ImagePort* const port = port_of(lane);
        const auto image = port == nullptr ? invocations_.images.end() : invocations_.images.find(port->name);
        return image == invocations_.images.end()
                   ? nullptr
                   : evaluate::pattern_of(image->second, step_.first_invocation + lane);
    }

    const Step& step_;
    const evaluate::Invocations& invocations_;
    ImageCall call_;
};

}  // namespace

std::vector<ImageFault> image_faults(const Step& step, const evaluate::Invocations& invocations,
                                     Lanes callers) {
    std::vector<ImageFault> faults;
    const auto add = [&](std::string_view message, Lanes lanes) {
        if (lanes != 0) faults.push_back({message, lanes});
    };
    const auto add_parted = [&] {
        add(kParted, parted(step, callers, false));
        add(kPartedByDiscard, parted(step, callers, true));
    };
    if (step.row().kind == evaluate::Kind::derivative) {
        add_parted();
        return faults;
    }
    const ImageStep image(step, invocations);
    // A shadow map has one level, so that none is chosen by derivatives.
    if (image.is_implicit() && !image.is_shadow()) add_parted();
    add("a projected texture coordinate whose divisor is not above 0", image.projects_from_behind());
    add("a cube map is looked up along a zero vector", image.is_along_nothing());
    if (image.is_fetch()) add("texelFetch() outside of the texture", image.fetches_outside());
    add("a level that the texture does not have", image.has_no_such_level());
    return faults;
}

}  // namespace gobo::sanitize
