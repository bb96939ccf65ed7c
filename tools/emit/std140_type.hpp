// The C++ type of a member of a uniform block, from its reflected layout.
#pragma once

#include <optional>
#include <string>

#include "reflect/interface.hpp"

namespace gobo {

/// A C++ type of known size, to be declared as `TYPE NAME EXTENTS`.
struct CppMemberType {
    std::string type;     ///< "std140::vec3"
    std::string extents;  ///< "[3][2]", or empty
    int size = 0;         ///< bytes, all elements together
};

/// The C++ of a GLSL scalar, vector or matrix with the strides it was reflected with. Nothing where the type
/// is none of these (a struct) or no C++ type has that layout.
[[nodiscard]] std::optional<CppMemberType> cpp_type_of(const Member& member);

/// An array of `element`, whose size is `element_size`, with the extents and the stride of `member`;
/// `element` itself where the member is no array. Nothing where the stride is less than the element's size.
[[nodiscard]] std::optional<CppMemberType> cpp_array_of(const std::string& element, int element_size,
                                                        const Member& member);

/// Bytes from one innermost element of an array to the next; 0 where the member is no array.
[[nodiscard]] int element_stride(const Member& member);

}  // namespace gobo
