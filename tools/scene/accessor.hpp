// Accessors: typed, strided, possibly sparse arrays within buffers, each checked before anything is read
// through it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/buffers.hpp"
#include "scene/document.hpp"

namespace gobo::scene {

/// Component types, by OpenGL's numbers as glTF has them.
enum class Component {
    signed_byte = 5120,
    unsigned_byte = 5121,
    signed_short = 5122,
    unsigned_short = 5123,
    unsigned_int = 5125,
    float_number = 5126,
};

/// What a use of an accessor accepts.
struct Wanted {
    std::vector<std::string_view> shapes;  ///< "SCALAR", "VEC3", ...
    std::vector<Component> components;
};

/// The values of an accessor, element after element.
struct Values {
    std::size_t width = 0;  ///< components of an element
    std::size_t count = 0;  ///< elements
    std::vector<double> numbers;

    [[nodiscard]] double at(std::size_t element, std::size_t component) const {
        return numbers[element * width + component];
    }
};

/// All accessors of a document.
class Accessors {
  public:
    /// Reads and checks every buffer view and accessor: whatever lies outside its buffer is an error of the
    /// document.
    Accessors(Document& document, const Buffers& buffers);

    [[nodiscard]] std::size_t size() const { return accessors_.size(); }
    /// The bytes of a buffer view named by a member; nothing where there is no such member, or it is wrong.
    [[nodiscard]] std::optional<std::string_view> view(const Value& parent, std::string_view name);
    /// The values of an accessor, normalized ones as numbers from 0 or -1 to 1. `user` names what uses it in
    /// messages. A kind that is not wanted, and numbers that are not finite, are errors of the document; the
    /// result is then empty.
    [[nodiscard]] Values read(int accessor, const Wanted& wanted, std::string_view user);

  private:
    struct View {
        std::string_view bytes;
        std::size_t stride = 0;  ///< 0: elements lie close together
    };
    struct Sparse {
        std::size_t count = 0;
        View indices;
        Component index_component = Component::unsigned_int;
        View values;
    };
    struct Accessor {
        std::string path;
        std::string shape;
        std::size_t width = 1;
        Component component = Component::float_number;
        bool normalized = false;
        std::size_t count = 0;
        std::optional<View> view;  ///< begins at the first element; none: all zero
        std::optional<Sparse> sparse;
    };

    void read_views(const Buffers& buffers);
    [[nodiscard]] Accessor read_accessor(const Value& value);
    [[nodiscard]] Component read_component(const Value& value);
    [[nodiscard]] std::optional<View> view_from(const Value& value, std::size_t element_size,
                                                std::size_t component_size, std::size_t count);
    [[nodiscard]] std::optional<Sparse> read_sparse(const Value& value, const Accessor& accessor);
    void apply(const Accessor& accessor, const Sparse& sparse, Values& values);
    [[nodiscard]] bool accepts(const Accessor& accessor, const Wanted& wanted, std::string_view user);

    Document& document_;
    std::vector<View> views_;
    std::vector<Accessor> accessors_;
    std::size_t components_read_ = 0;
};

}  // namespace gobo::scene
