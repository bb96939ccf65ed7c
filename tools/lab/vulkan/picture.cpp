#include "lab/vulkan/picture.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include <fmt/format.h>

#include "lab/render/chosen_values.hpp"
#include "lab/vulkan/bindings.hpp"
#include "lab/vulkan/pipelines.hpp"
#include "lab/vulkan/target.hpp"

namespace gobo::vulkan {
namespace {

/// Components of 32 bits.
VkFormat format_of(int components, bool is_integer) {
    const int first = is_integer ? VK_FORMAT_R32_SINT : VK_FORMAT_R32_SFLOAT;
    return static_cast<VkFormat>(first + 3 * (components - 1));
}

/// One object ready to be drawn.
struct Item {
    std::vector<AttributeBuffer> attributes;
    std::vector<VkDescriptorSet> sets;
    VkPipeline pipeline = VK_NULL_HANDLE;
    VkBuffer indices = VK_NULL_HANDLE;
    std::uint32_t index_count = 0;
    std::vector<std::byte> pushed;
};

/// Draws objects by the stages of one permutation to a target.
class Drawing {
  public:
    Drawing(Resources& resources, const std::vector<StageModule>& stages, const Interface& interface,
            const Target& target, const DepthBias* bias, const DrawStart& start)
        : resources_(resources),
          interface_(interface),
          start_(start),
          bindings_(resources, interface),
          pipelines_(resources, stages, target, bias != nullptr ? *bias : DepthBias(),
                     bias == nullptr && writes_color(interface)) {}

    /// For so many objects.
    Result<void> prepare(std::size_t objects, const std::vector<RenderValue>& values) {
        GOBO_TRY_DO(bindings_.make(objects, values));
        return pipelines_.make(bindings_.layout());
    }

    /// Draws an object, by the number that add() gave it, within a render pass.
    void draw(VkCommandBuffer commands, std::size_t number) const {
        const Functions& vk = resources_.state().vk;
        const Item& item = items_[number];
        if (item.index_count == 0) return;
        if (!item.sets.empty())
            vk.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, bindings_.layout(), 0,
                                       size_of(item.sets), item.sets.data(), 0, nullptr);
        vk.vkCmdBindIndexBuffer(commands, item.indices, 0, VK_INDEX_TYPE_UINT32);
        if (pipelines_.nothing() != VK_NULL_HANDLE) {
            vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.nothing());
            vk.vkCmdDrawIndexed(commands, 3, 1, 0, 0, 0);
        }
        vk.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, item.pipeline);
        const VkDeviceSize start = 0;
        for (std::uint32_t binding = 0; binding < size_of(item.attributes); ++binding)
            vk.vkCmdBindVertexBuffers(commands, binding, 1, &item.attributes[binding].buffer, &start);
        if (!item.pushed.empty())
            vk.vkCmdPushConstants(commands, bindings_.layout(), bindings_.push_stages(), 0,
                                  size_of(item.pushed), item.pushed.data());
        vk.vkCmdDrawIndexed(commands, item.index_count, 1, 0, start_.vertex, start_.instance);
    }

    /// Makes an object ready, and says its number.
    Result<std::size_t> add(const Draw& draw, const std::vector<RenderValue>& values, ViewedObject view) {
        const Object& object = draw.object;
        view.model = object.model;
        std::vector<RenderValue> all = values;
        all.insert(all.end(), object.values.begin(), object.values.end());
        GOBO_TRY(const ResolvedUniforms resolved, resolve_uniforms(interface_, all, view));
        for (const Diagnostic& diagnostic : resolved.warnings) warn(diagnostic);
        Item item;
        GOBO_TRY(item.sets, bindings_.sets_of(resolved, draw.textures));
        GOBO_TRY_DO(add_attributes(item, object.mesh, all));
        std::vector<std::uint32_t> indices = object.mesh.indices;
        // Vulkan takes flat values from the first vertex of a triangle, OpenGL from the last.
        if (start_.flat_from_last && pipelines_.draws_triangles())
            for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
                std::rotate(&indices[i], &indices[i + 2], &indices[i] + 3);
        GOBO_TRY(const Buffer buffer, resources_.make_buffer(VK_BUFFER_USAGE_INDEX_BUFFER_BIT, indices.data(),
                                                             indices.size() * sizeof(std::uint32_t)));
        item.indices = buffer.buffer;
        item.index_count = size_of(indices);
        const VkCullModeFlags none = VK_CULL_MODE_NONE;
        const VkCullModeFlags back = object.is_mirrored() ? VK_CULL_MODE_FRONT_BIT : VK_CULL_MODE_BACK_BIT;
        GOBO_TRY(item.pipeline,
                 pipelines_.of(object.culls_back_faces ? back : none, draw.is_blended, item.attributes));
        item.pushed = pushed_bytes(interface_, resolved.assignments);
        items_.push_back(std::move(item));
        return items_.size() - 1;
    }

    [[nodiscard]] const Diagnostics& warnings() const { return warnings_; }

  private:
    void warn(Diagnostic warning) {
        if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
            warnings_.push_back(std::move(warning));
    }

    /// Attributes of one location.
    Result<void> add_attributes(Item& item, const Mesh& mesh, const std::vector<RenderValue>& values) {
        for (const Variable& input : interface_.inputs) {
            const GlslType type = glsl_type(input.type).value_or(GlslType{});
            if (type.is_matrix() || !input.array.empty())
                return fail(Fault::input,
                            fmt::format("the renderer has no values for the attribute '{}' of type "
                                        "{}",
                                        input.name, input.type));
            AttributeBuffer attribute;
            attribute.location = static_cast<std::uint32_t>(input.location);
            const bool is_integer = type.scalar != Scalar::float32;
            GOBO_TRY(ChosenAttribute chosen, chosen_attribute(input.name, mesh, values));
            if (chosen.warning) warn(*std::move(chosen.warning));
            AttributeValues& given = chosen.values;
            if (is_integer && given.integers.empty())
                for (const float number : given.floats)
                    given.integers.push_back(static_cast<std::int32_t>(number));
            const bool has_integers = !given.integers.empty();
            attribute.format = format_of(given.components, has_integers);
            attribute.stride = chosen.is_constant ? 0 : 4 * static_cast<std::uint32_t>(given.components);
            const void* data = has_integers ? static_cast<const void*>(given.integers.data())
                                            : static_cast<const void*>(given.floats.data());
            const std::size_t count = has_integers ? given.integers.size() : given.floats.size();
            GOBO_TRY(const Buffer buffer,
                     resources_.make_buffer(VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, data, 4 * count));
            attribute.buffer = buffer.buffer;
            item.attributes.push_back(attribute);
        }
        return {};
    }

    Resources& resources_;
    const Interface& interface_;
    DrawStart start_;
    Bindings bindings_;
    Pipelines pipelines_;
    std::vector<Item> items_;
    Diagnostics warnings_;
};

void begin_pass(const Functions& vk, VkCommandBuffer commands, const Target& target,
                const std::array<float, 4>& background) {
    std::vector<VkClearValue> cleared;
    VkClearValue value{};
    std::copy(background.begin(), background.end(), value.color.float32);
    if (target.has_color) cleared.push_back(value);
    value.depthStencil = {1, 0};
    cleared.push_back(value);
    auto begin = made<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    begin.renderPass = target.pass;
    begin.framebuffer = target.framebuffer;
    begin.renderArea = {{0, 0}, target.extent};
    begin.clearValueCount = size_of(cleared);
    begin.pClearValues = cleared.data();
    vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
}

/// Draws, and reads what came of it.
Result<Picture> take_picture(Resources& resources, const Target& target,
                             const std::array<float, 4>& background,
                             const std::function<void(VkCommandBuffer)>& draw) {
    const Functions& vk = resources.state().vk;
    const std::size_t pixels = std::size_t{target.extent.width} * target.extent.height;
    const auto width = static_cast<int>(target.extent.width);
    const auto height = static_cast<int>(target.extent.height);
    Picture picture;
    picture.depth = Image(width, height, 1);
    if (target.has_color) picture.color = Image(width, height, 4);
    GOBO_TRY(const Buffer colors,
             resources.make_buffer(VK_BUFFER_USAGE_TRANSFER_DST_BIT, nullptr, 4 * sizeof(float) * pixels));
    GOBO_TRY(const Buffer depths,
             resources.make_buffer(VK_BUFFER_USAGE_TRANSFER_DST_BIT, nullptr, sizeof(float) * pixels));
    const auto read = [&](VkCommandBuffer commands, const DeviceImage& image, const ImageShape& shape,
                          VkImageLayout layout, const Buffer& to) {
        change_layout(vk, commands, image.image, shape, layout, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {shape.aspect, 0, 0, 1};
        copy.imageExtent = {target.extent.width, target.extent.height, 1};
        vk.vkCmdCopyImageToBuffer(commands, image.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to.buffer, 1,
                                  &copy);
    };
    GOBO_TRY_DO(resources.run([&](VkCommandBuffer commands) {
        begin_pass(vk, commands, target, background);
        draw(commands);
        vk.vkCmdEndRenderPass(commands);
        if (target.has_color)
            read(commands, target.color, target.color_shape, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                 colors);
        read(commands, target.depth, target.depth_shape, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL,
             depths);
        auto barrier = made<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
        barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
        vk.vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                                &barrier, 0, nullptr, 0, nullptr);
    }));
    const auto copy = [](const Buffer& from, Image& to) {
        const auto* const first = static_cast<const float*>(from.data);
        std::copy(first, first + to.values.size(), to.values.begin());
    };
    if (target.has_color) copy(colors, picture.color);
    copy(depths, picture.depth);
    return picture;
}

/// All draws to one target; where there is a bias, their depths alone.
Result<Picture> draw_all(Resources& resources, const Target& target, const std::vector<DrawnBy>& permutations,
                         const std::vector<Draw>& draws, const ViewedObject& view,
                         const std::array<float, 4>& background, const DepthBias* bias,
                         const DrawStart& start, const std::function<void(std::size_t)>& begins) {
    std::vector<std::unique_ptr<Drawing>> drawings;
    for (std::size_t i = 0; i < permutations.size(); ++i) {
        const DrawnBy& by = permutations[i];
        if (begins) begins(i);
        drawings.push_back(
            std::make_unique<Drawing>(resources, by.stages, by.interface, target, bias, start));
        const auto objects = std::ranges::count(draws, i, &Draw::by);
        GOBO_TRY_DO(drawings.back()->prepare(static_cast<std::size_t>(objects), by.values));
    }
    std::vector<std::size_t> numbers;
    for (const Draw& draw : draws) {
        if (begins) begins(draw.by);
        GOBO_TRY(const std::size_t number, drawings[draw.by]->add(draw, permutations[draw.by].values, view));
        numbers.push_back(number);
    }
    GOBO_TRY(Picture picture, take_picture(resources, target, background, [&](VkCommandBuffer commands) {
                 for (std::size_t i = 0; i < draws.size(); ++i)
                     drawings[draws[i].by]->draw(commands, numbers[i]);
             }));
    for (const auto& drawing : drawings)
        for (const Diagnostic& warning : drawing->warnings())
            if (std::ranges::find(picture.warnings, warning) == picture.warnings.end())
                picture.warnings.push_back(warning);
    return picture;
}

/// An error where the validation layers have said something.
Result<void> no_messages(const Device& device) {
    if (Diagnostics messages = device.messages(); !messages.empty())
        return tl::unexpected(std::move(messages));
    return {};
}

}  // namespace

std::vector<StageModule> modules_of(const std::vector<std::span<const std::uint32_t>>& modules,
                                    const Permutation& permutation) {
    std::vector<StageModule> stages;
    for (const StageNames& stage : kStages)
        if (const int number = permutation.stages[stage.kind]; number >= 0)
            stages.push_back(
                {stage.kind, modules[static_cast<std::size_t>(number)], permutation.specialized});
    return stages;
}

Result<Picture> render_draws(const Device& device, const std::vector<DrawnBy>& permutations,
                             const std::vector<Draw>& draws, ViewedObject view, int width, int height,
                             const std::array<float, 4>& background,
                             const std::function<void(std::size_t)>& begins, const DrawStart& start) {
    Resources resources(device);
    GOBO_TRY(const Target target, make_target(resources, width, height, true));
    view.projection = vulkan_clip_space_of_pictures() * view.projection;
    GOBO_TRY(Picture picture,
             draw_all(resources, target, permutations, draws, view, background, nullptr, start, begins));
    GOBO_TRY_DO(no_messages(device));
    return picture;
}

Result<Picture> render_permutation(const Device& device, const std::vector<StageModule>& stages,
                                   const Interface& interface, const std::vector<Object>& objects,
                                   const std::vector<RenderValue>& values, const View& view,
                                   const Textures& textures, const DrawStart& start) {
    std::vector<Draw> draws;
    for (const Object& object : objects) draws.push_back({0, object, textures, false});
    return render_draws(device, {{stages, interface, values}}, draws, viewed_from(view), view.width,
                        view.height, view.background, {}, start);
}

Result<std::vector<Image>> draw_shadow_maps(const Device& device, const ShadowPass& pass,
                                            const ShadowPlan& plan, const std::vector<Object>& objects,
                                            const std::vector<DrawnBy>& permutations,
                                            const std::vector<Draw>& with_holes) {
    const DepthBias bias{static_cast<float>(pass.slope), static_cast<float>(pass.units)};
    const Textures none;
    // The pass comes first, and what draws holes behind it.
    std::vector<DrawnBy> all = {{pass.stages, pass.interface, pass.values}};
    std::vector<Draw> draws;
    for (const Object& object : objects)
        if (object.shadow_shape == ShadowShape::whole) draws.push_back({0, object, none, false});
    if (!with_holes.empty())
        for (const DrawnBy& permutation : permutations) all.push_back(permutation);
    for (const Draw& draw : with_holes) draws.push_back({draw.by + 1, draw.object, draw.textures, false});
    std::vector<Image> maps;
    for (const ShadowCamera& camera : plan.cameras) {
        Resources resources(device);
        // What draws holes writes colours, too.
        GOBO_TRY(const Target target, make_target(resources, pass.side, pass.side, !with_holes.empty()));
        const ViewedObject viewed{glm::dmat4(1),
                                  camera.view,
                                  vulkan_clip_space_of_maps() * camera.projection,
                                  {pass.side, pass.side}};
        GOBO_TRY(Picture picture, draw_all(resources, target, all, draws, viewed, {}, &bias, {}, {}));
        maps.push_back(std::move(picture.depth));
    }
    GOBO_TRY_DO(no_messages(device));
    return maps;
}

}  // namespace gobo::vulkan
