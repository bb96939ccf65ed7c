// Loads, stores, addresses, and taking composites apart and putting them together.
#include <algorithm>
#include <cstring>

#include "lab/evaluate/loops.hpp"

namespace gobo::evaluate {
namespace {

template <class T>
void copy_rows(Machine<T>& machine, std::uint32_t to, std::uint32_t from, std::uint32_t count) {
    if (to == from) return;  // a value that shares its slots with another
    std::memmove(machine.reals(to), machine.reals(from), count * kLanes * sizeof(T));
}

template <class T>
void copy(const Operation& operation, Machine<T>& machine) {
    copy_rows(machine, operation.result, operation.operands[0], operation.count);
}

template <class T>
void keep(const Operation& operation, Machine<T>& machine) {
    if (machine.is_full()) return copy(operation, machine);
    // As whole numbers: it is their bytes that are copied.
    const Whole<T>* mask = machine.mask_row();
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        Whole<T>* result = machine.wholes(operation.result + component);
        const Whole<T>* value = machine.wholes(operation.operands[0] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = (value[lane] & mask[lane]) | (result[lane] & ~mask[lane]);
    }
}

/// Words: the slot of an offset to start from plus 1, or 0; then for each index its slot, the extent it is
/// clamped to, and the slots from one element to the next.
template <class T>
void address(const Operation& operation, Machine<T>& machine) {
    const std::uint32_t* words = machine.words(operation);
    Whole<T>* result = machine.wholes(operation.result);
    if (words[0] == 0)
        std::fill_n(result, kLanes, 0);
    else
        copy_rows(machine, operation.result, words[0] - 1, 1);
    for (std::uint32_t at = 1; at < operation.extras; at += 3) {
        const Whole<T>* index = machine.wholes(words[at]);
        const Whole<T> last = static_cast<Whole<T>>(words[at + 1]) - 1;
        const Whole<T> stride = static_cast<Whole<T>>(words[at + 2]);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] +=
                std::clamp<Whole<T>>(static_cast<Whole<T>>(to_signed(index[lane])), 0, last) * stride;
    }
}

/// Where all lanes hold the same offset, that offset; otherwise -1.
template <class T>
Whole<T> common_offset(const Whole<T>* offsets) {
    Whole<T> differences = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) differences |= offsets[lane] ^ offsets[0];
    return differences == 0 ? offsets[0] : -1;
}

template <class T>
void gather(const Operation& operation, Machine<T>& machine) {
    const Whole<T>* offsets = machine.wholes(operation.operands[1]);
    const Whole<T> common = common_offset<T>(offsets);
    if (common >= 0) {
        const auto from = operation.operands[0] + static_cast<std::uint32_t>(common);
        return copy_rows(machine, operation.result, from, operation.count);
    }
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        Whole<T>* __restrict result = machine.wholes(operation.result + component);
        const Whole<T>* from = machine.wholes(operation.operands[0] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] = from[static_cast<std::size_t>(offsets[lane]) * kLanes + lane];
    }
}

template <class T>
void scatter(const Operation& operation, Machine<T>& machine) {
    const Whole<T>* offsets = machine.wholes(operation.operands[1]);
    for (std::uint32_t component = 0; component < operation.count; ++component) {
        Whole<T>* to = machine.wholes(operation.result + component);
        const Whole<T>* value = machine.wholes(operation.operands[0] + component);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            if (machine.is_active(lane))
                to[static_cast<std::size_t>(offsets[lane]) * kLanes + lane] = value[lane];
    }
}

/// Words: pairs of a first slot and a count, put one after the other.
template <class T>
void construct(const Operation& operation, Machine<T>& machine) {
    const std::uint32_t* words = machine.words(operation);
    std::uint32_t to = operation.result;
    for (std::uint32_t at = 0; at < operation.extras; at += 2) {
        copy_rows(machine, to, words[at], words[at + 1]);
        to += words[at + 1];
    }
}

/// Words: a slot for each component.
template <class T>
void shuffle(const Operation& operation, Machine<T>& machine) {
    for (std::uint32_t component = 0; component < operation.count; ++component)
        copy_rows(machine, operation.result + component, machine.words(operation)[component], 1);
}

/// Operands: the part, the whole. Words: where in the whole, and the part's slots.
template <class T>
void insert(const Operation& operation, Machine<T>& machine) {
    copy_rows(machine, operation.result, operation.operands[1], operation.count);
    const std::uint32_t* words = machine.words(operation);
    copy_rows(machine, operation.result + words[0], operation.operands[0], words[1]);
}

template <class T>
std::uint32_t clamped(Machine<T>& machine, std::uint32_t slot, std::size_t lane, std::uint32_t extent) {
    const std::int32_t index = to_signed(machine.wholes(slot)[lane]);
    return static_cast<std::uint32_t>(std::clamp(index, 0, static_cast<std::int32_t>(extent) - 1));
}

// Words of both: the vector's components.
template <class T>
void extract_dynamic(const Operation& operation, Machine<T>& machine) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::uint32_t index =
            clamped(machine, operation.operands[1], lane, machine.words(operation)[0]);
        machine.wholes(operation.result)[lane] = machine.wholes(operation.operands[0] + index)[lane];
    }
}

template <class T>
void insert_dynamic(const Operation& operation, Machine<T>& machine) {
    copy_rows(machine, operation.result, operation.operands[0], operation.count);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::uint32_t index =
            clamped(machine, operation.operands[2], lane, machine.words(operation)[0]);
        machine.wholes(operation.result + index)[lane] = machine.wholes(operation.operands[1])[lane];
    }
}

constexpr Row kRows[] = {
    {spv::OpLoad, "Load", Kind::load, "", {&copy<float>, &copy<double>}},
    {spv::OpStore, "Store", Kind::store, "", {&keep<float>, &keep<double>}},
    {spv::OpCompositeExtract, "CompositeExtract", Kind::move, "", {&copy<float>, &copy<double>}},
    {spv::OpCompositeConstruct,
     "CompositeConstruct",
     Kind::move,
     "",
     {&construct<float>, &construct<double>}},
    {spv::OpCompositeInsert, "CompositeInsert", Kind::move, "", {&insert<float>, &insert<double>}},
    {spv::OpVectorShuffle, "VectorShuffle", Kind::move, "", {&shuffle<float>, &shuffle<double>}},
    {spv::OpVectorExtractDynamic,
     "VectorExtractDynamic",
     Kind::move,
     "",
     {&extract_dynamic<float>, &extract_dynamic<double>}},
    {spv::OpVectorInsertDynamic,
     "VectorInsertDynamic",
     Kind::move,
     "",
     {&insert_dynamic<float>, &insert_dynamic<double>}},
    {spv::OpAccessChain, "AccessChain", Kind::move, "", {&address<float>, &address<double>}},
    {kKeep, "", Kind::move, "", {&keep<float>, &keep<double>}},
    {kGather, "Load", Kind::load, "", {&gather<float>, &gather<double>}},
    {kScatter, "Store", Kind::store, "", {&scatter<float>, &scatter<double>}},
};

}  // namespace

std::span<const Row> memory_rows() {
    return kRows;
}

}  // namespace gobo::evaluate
