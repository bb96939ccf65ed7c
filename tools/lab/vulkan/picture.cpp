#include "lab/vulkan/picture.hpp"

#include <algorithm>
#include <array>

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
            const Target& target, DepthBias bias, const DrawStart& start = {})
        : resources_(resources),
          interface_(interface),
          target_(target),
          start_(start),
          bindings_(resources, interface),
          pipelines_(resources, stages, target, bias, writes_color(interface)) {}

    Result<void> prepare(const std::vector<Object>& objects, const std::vector<RenderValue>& values,
                         const ViewedObject& view, const Textures& textures) {
        GOBO_TRY_DO(bindings_.make(objects.size(), values, textures));
        GOBO_TRY_DO(pipelines_.make(bindings_.layout()));
        for (const Object& object : objects) GOBO_TRY_DO(add(object, values, view));
        return {};
    }

    void draw(VkCommandBuffer commands, const std::array<float, 4>& background) const {
        const Functions& vk = resources_.state().vk;
        std::vector<VkClearValue> cleared;
        VkClearValue value{};
        std::copy(background.begin(), background.end(), value.color.float32);
        if (target_.has_color) cleared.push_back(value);
        value.depthStencil = {1, 0};
        cleared.push_back(value);
        auto begin = made<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
        begin.renderPass = target_.pass;
        begin.framebuffer = target_.framebuffer;
        begin.renderArea = {{0, 0}, target_.extent};
        begin.clearValueCount = size_of(cleared);
        begin.pClearValues = cleared.data();
        vk.vkCmdBeginRenderPass(commands, &begin, VK_SUBPASS_CONTENTS_INLINE);
        for (const Item& item : items_) {
            if (item.index_count == 0) continue;
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
        vk.vkCmdEndRenderPass(commands);
    }

    [[nodiscard]] Diagnostics take_warnings() { return std::move(warnings_); }

  private:
    void warn(Diagnostic warning) {
        if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end())
            warnings_.push_back(std::move(warning));
    }

    Result<void> add(const Object& object, const std::vector<RenderValue>& values, ViewedObject view) {
        view.model = object.model;
        std::vector<RenderValue> all = values;
        all.insert(all.end(), object.values.begin(), object.values.end());
        GOBO_TRY(const ResolvedUniforms resolved, resolve_uniforms(interface_, all, view));
        for (const Diagnostic& diagnostic : resolved.warnings) warn(diagnostic);
        Item item;
        GOBO_TRY(item.sets, bindings_.sets_of(resolved));
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
        GOBO_TRY(item.pipeline, pipelines_.of(object.culls_back_faces ? back : none, item.attributes));
        item.pushed = pushed_bytes(interface_, resolved.assignments);
        items_.push_back(std::move(item));
        return {};
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
    const Target& target_;
    DrawStart start_;
    Bindings bindings_;
    Pipelines pipelines_;
    std::vector<Item> items_;
    Diagnostics warnings_;
};

/// Draws, and reads what came of it.
Result<Picture> take_picture(Resources& resources, const Target& target, const Drawing& drawing,
                             const std::array<float, 4>& background) {
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
        drawing.draw(commands, background);
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

glm::dmat4 clip_space_of_maps() {
    glm::dmat4 matrix(1);
    matrix[2][2] = 0.5;  // z' = z / 2 + w / 2
    matrix[3][2] = 0.5;
    return matrix;
}

glm::dmat4 clip_space_of_pictures() {
    glm::dmat4 matrix = clip_space_of_maps();
    matrix[1][1] = -1;
    return matrix;
}

Result<Picture> render_permutation(const Device& device, const std::vector<StageModule>& stages,
                                   const Interface& interface, const std::vector<Object>& objects,
                                   const std::vector<RenderValue>& values, const View& view,
                                   const Textures& textures, const DrawStart& start) {
    Resources resources(device);
    GOBO_TRY(const Target target, make_target(resources, view.width, view.height, true));
    Drawing drawing(resources, stages, interface, target, {}, start);
    ViewedObject viewed = viewed_from(view);
    viewed.projection = clip_space_of_pictures() * viewed.projection;
    GOBO_TRY_DO(drawing.prepare(objects, values, viewed, textures));
    GOBO_TRY(Picture picture, take_picture(resources, target, drawing, view.background));
    picture.warnings = drawing.take_warnings();
    if (Diagnostics messages = device.messages(); !messages.empty())
        return tl::unexpected(std::move(messages));
    return picture;
}

Result<std::vector<Image>> draw_shadow_maps(const Device& device, const ShadowPass& pass,
                                            const ShadowPlan& plan, const std::vector<Object>& objects) {
    std::vector<Image> maps;
    for (const ShadowCamera& camera : plan.cameras) {
        Resources resources(device);
        GOBO_TRY(const Target target, make_target(resources, pass.side, pass.side, false));
        Drawing drawing(resources, pass.stages, pass.interface, target,
                        {static_cast<float>(pass.slope), static_cast<float>(pass.units)});
        const ViewedObject viewed{
            glm::dmat4(1), camera.view, clip_space_of_maps() * camera.projection, {pass.side, pass.side}};
        GOBO_TRY_DO(drawing.prepare(objects, pass.values, viewed, {}));
        GOBO_TRY(Picture picture, take_picture(resources, target, drawing, {}));
        maps.push_back(std::move(picture.depth));
    }
    if (Diagnostics messages = device.messages(); !messages.empty())
        return tl::unexpected(std::move(messages));
    return maps;
}

}  // namespace gobo::vulkan
