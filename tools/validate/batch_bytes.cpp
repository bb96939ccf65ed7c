// A BatchResult as bytes. The fields of each struct are named one by one, so that a field which is added
// there does not compile until it is added here.
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "validate/batch.hpp"

namespace gobo {
namespace {

template <class T, class... Others>
concept OneOf = (std::is_same_v<std::remove_const_t<T>, Others> || ...);

void fields(auto& archive, OneOf<Place> auto& value) {
    auto& [file, line, column] = value;
    archive(file, line, column);
}
void fields(auto& archive, OneOf<Diagnostic> auto& value) {
    auto& [severity, fault, place, message, quoted_line, help, subject] = value;
    archive(severity, fault, place, message, quoted_line, help, subject);
}
void fields(auto& archive, OneOf<Usage> auto& value) {
    auto& [unused, anonymous, relaxed] = value;
    archive(unused, anonymous, relaxed);
}
void fields(auto& archive, OneOf<Interpolation> auto& value) {
    auto& [flat, noperspective, centroid, sample, invariant] = value;
    archive(flat, noperspective, centroid, sample, invariant);
}
void fields(auto& archive, OneOf<Member> auto& value) {
    auto& [name, type, offset, array, array_stride, matrix_stride, row_major, members] = value;
    archive(name, type, offset, array, array_stride, matrix_stride, row_major, members);
}
void fields(auto& archive, OneOf<Block> auto& value) {
    auto& [name, binding, size, stages, members, usage] = value;
    archive(name, binding, size, stages, members, usage);
}
void fields(auto& archive, OneOf<Uniform> auto& value) {
    auto& [name, type, location, array, members, stages, usage] = value;
    archive(name, type, location, array, members, stages, usage);
}
void fields(auto& archive, OneOf<Sampler> auto& value) {
    auto& [name, type, binding, array, stages, usage] = value;
    archive(name, type, binding, array, stages, usage);
}
void fields(auto& archive, OneOf<Variable> auto& value) {
    auto& [name, type, location, array, component, interpolation, per_vertex, patch, usage] = value;
    archive(name, type, location, array, component, interpolation, per_vertex, patch, usage);
}
void fields(auto& archive, OneOf<Interface> auto& value) {
    auto& [stages, blocks, storage_blocks, uniforms, samplers, inputs, outputs] = value;
    archive(stages, blocks, storage_blocks, uniforms, samplers, inputs, outputs);
}
void fields(auto& archive, OneOf<ValidatedStage> auto& value) {
    auto& [spirv, hash, interface, diagnostics] = value;
    archive(spirv, hash, interface, diagnostics);
}
void fields(auto& archive, OneOf<BatchResult::OfStage> auto& value) {
    auto& [stage, is_fine, diagnostics, validated] = value;
    archive(stage, is_fine, diagnostics, validated);
}
void fields(auto& archive, OneOf<BatchResult::OfProgram> auto& value) {
    auto& [program, diagnostics] = value;
    archive(program, diagnostics);
}
void fields(auto& archive, OneOf<BatchResult> auto& value) {
    auto& [stages, programs] = value;
    archive(stages, programs);
}

template <class T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Strings and vectors.
template <class T>
concept List = requires(T& value) {
    value.resize(1);
};

class Writer {
  public:
    void operator()(const auto&... values) { (put(values), ...); }
    [[nodiscard]] std::string result() && { return std::move(bytes_); }

  private:
    void put_raw(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }

    template <class T>
    void put(const T& value) {
        if constexpr (Plain<T>) {
            put_raw(&value, sizeof value);
        } else if constexpr (List<T>) {
            put(std::uint64_t{value.size()});
            if constexpr (Plain<typename T::value_type>)
                put_raw(value.data(), value.size() * sizeof(typename T::value_type));
            else
                for (const auto& element : value) put(element);
        } else {
            fields(*this, value);
        }
    }

    std::string bytes_;
};

class Reader {
  public:
    explicit Reader(std::string_view bytes) : bytes_(bytes) {}

    void operator()(auto&... values) { (take(values), ...); }
    [[nodiscard]] bool is_fine() const { return is_fine_ && bytes_.empty(); }

  private:
    void take_raw(void* data, std::size_t size) {
        is_fine_ = is_fine_ && size <= bytes_.size();
        if (!is_fine_ || size == 0) return;
        std::memcpy(data, bytes_.data(), size);
        bytes_.remove_prefix(size);
    }

    template <class T>
    void take(T& value) {
        if constexpr (Plain<T>) {
            take_raw(&value, sizeof value);
        } else if constexpr (List<T>) {
            using Element = typename T::value_type;
            std::uint64_t size = 0;
            take(size);
            is_fine_ = is_fine_ && size <= bytes_.size();  // each element takes a byte at least
            if (!is_fine_) return;
            if constexpr (Plain<Element>) {
                is_fine_ = size * sizeof(Element) <= bytes_.size();
                if (is_fine_) value.resize(size);
                take_raw(value.data(), is_fine_ ? size * sizeof(Element) : 0);
            } else {
                for (; size > 0 && is_fine_; --size) take(value.emplace_back());
            }
        } else {
            fields(*this, value);
        }
    }

    std::string_view bytes_;
    bool is_fine_ = true;
};

}  // namespace

std::string bytes_of(const BatchResult& result) {
    Writer writer;
    writer(result);
    return std::move(writer).result();
}

std::optional<BatchResult> result_of(std::string_view bytes) {
    BatchResult result;
    Reader reader(bytes);
    reader(result);
    return reader.is_fine() ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace gobo
