// The numbers of a glTF file: its container, its buffers wherever they lie (in the container, in the JSON, in
// files beside it), and accessors, which are typed, strided, possibly sparse arrays within buffers. Each is
// checked before anything is read through it. That is why no glTF library reads them: what is wrong must be
// told with its path in the file, and no index or extent may be trusted.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_system.hpp"
#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace gobo::scene {

/// The parts of a glTF file; they refer to its content.
struct Container {
    std::string_view json;
    std::optional<std::string_view> binary;  ///< the buffer that a .glb holds
};

/// Takes a file apart. What begins with "glTF" is a container of version 2 (glTF 2.0 specification, ch. 4),
/// anything else is JSON. An error where a container is cut short or its chunks are not as they must be.
[[nodiscard]] Container open_container(std::string_view content);

/// What a `uri` of the scene's file names: data in base64, or a file beside it, which is added to the
/// scene's. Fault::file where it cannot be read.
[[nodiscard]] std::string read_uri(const FileSystem& disk, const Value& uri, Scene& scene);

/// The contents of every buffer of the document, each of exactly its byteLength.
[[nodiscard]] std::vector<std::string> read_buffers(const FileSystem& disk, const Value& root,
                                                    std::optional<std::string_view> binary, Scene& scene);

/// Component types, in the order of their table.
enum class Component { int8, uint8, int16, uint16, uint32, float32 };

/// What a use of an accessor accepts.
struct Wanted {
    std::vector<std::string_view> shapes;  ///< "SCALAR", "VEC3", ...
    std::vector<Component> components;
};

/// The values of an accessor, element after element.
struct Values {
    std::size_t width = 0;  ///< components of an element
    std::size_t count = 0;  ///< elements; 0: there is no such accessor
    std::vector<double> numbers;

    [[nodiscard]] double at(std::size_t element, std::size_t component = 0) const {
        return numbers[element * width + component];
    }
    [[nodiscard]] glm::dvec3 triple(std::size_t element) const {
        return {at(element, 0), at(element, 1), at(element, 2)};
    }
};

/// All accessors of a document.
class Accessors {
  public:
    /// Reads and checks every buffer view and accessor: whatever lies outside its buffer is an error.
    Accessors(const Value& root, const std::vector<std::string>& buffers);

    /// The bytes of the buffer view whose number `user` holds; nothing where it is absent.
    [[nodiscard]] std::optional<std::string_view> view(const Value& user) const;
    /// Whether the accessor whose number `user` holds is there and has numbers in a buffer: others are zeros.
    [[nodiscard]] bool has_view(const Value& user) const;
    /// The values of the accessor whose number `user` holds, normalized ones as numbers from 0 or -1 to 1. A
    /// kind that is not wanted, and numbers that are not finite, are errors.
    [[nodiscard]] Values read(const Value& user, const Wanted& wanted);

  private:
    struct View {
        std::string_view bytes;
        std::size_t stride = 0;  ///< 0: elements lie close together
    };
    struct Array {
        std::string_view bytes;  ///< begin at the first element
        std::size_t stride = 0;  ///< 0: there are no bytes, all numbers are zero
        Component component = Component::float32;
        bool normalized = false;
        [[nodiscard]] double at(std::size_t element, std::size_t part) const;
    };
    struct Accessor {
        Value value;
        std::string shape;
        std::size_t count = 0;
        Array numbers;
        std::size_t sparse_count = 0;  ///< of elements that stand elsewhere
        Array sparse_indices;
        Array sparse_numbers;
    };

    [[nodiscard]] Accessor read_accessor(const Value& value) const;
    void read_array(const Value& value, std::string_view shape, std::size_t count, Array& array) const;

    std::vector<View> views_;
    std::vector<Accessor> accessors_;
    std::size_t components_read_ = 0;
};

/// The attributes of a primitive, a morph target or of instances: all have as many elements, those of the
/// first that is read unless `count` says how many.
struct Attributes {
    Accessors& accessors;
    Value attributes;
    std::string_view elements;  ///< what messages call them: "positions"
    std::size_t count = 0;

    [[nodiscard]] Values read(std::string_view name, const Wanted& wanted);
};

}  // namespace gobo::scene
