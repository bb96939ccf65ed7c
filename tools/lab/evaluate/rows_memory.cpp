// Loads, stores, addresses, and taking composites apart and putting them together.
#include <algorithm>
#include <cstring>

#include "lab/evaluate/rows.hpp"

namespace gobo::evaluate {
namespace {

template <class T>
void copy_rows(Registers<T>& registers, std::uint32_t to, std::uint32_t from, std::uint32_t count) {
    if (to == from) return;  // a value that shares its slots with another
    std::memmove(registers.floats(to), registers.floats(from), count * kLanes * sizeof(T));
}

constexpr auto kCopyAll = [](const Operation& operation, auto& registers) {
    copy_rows(registers, operation.result, operation.operands[0], operation.count);
};

/// As integers: what is copied is bytes.
constexpr auto kCopyActive = []<class T>(const Operation& operation, Registers<T>& registers) {
    if (registers.active() == kAllLanes) return kCopyAll(operation, registers);
    const Int<T>* mask = registers.mask_row();
    for_each_component<Ints>(operation, registers,
                             [&](Int<T>* result, const Int<T>* value, const Int<T>* /*b*/) {
                                 for (std::size_t lane = 0; lane < kLanes; ++lane)
                                     result[lane] = (value[lane] & mask[lane]) | (result[lane] & ~mask[lane]);
                             });
};

/// Words: the slot of an offset to start from plus 1, or 0; then for each index its slot, the extent it is
/// clamped to, and the slots from one element to the next.
constexpr auto kAddress = []<class T>(const Operation& operation, Registers<T>& registers) {
    const std::uint32_t* words = registers.words(operation);
    Int<T>* result = registers.ints(operation.result);
    if (words[0] == 0)
        std::fill_n(result, kLanes, 0);
    else
        copy_rows(registers, operation.result, words[0] - 1, 1);
    for (std::uint32_t at = 1; at < operation.extras; at += 3) {
        const Int<T>* index = registers.ints(words[at]);
        const Int<T> last = static_cast<Int<T>>(words[at + 1]) - 1;
        const Int<T> stride = static_cast<Int<T>>(words[at + 2]);
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            result[lane] += std::clamp<Int<T>>(static_cast<Int<T>>(to_signed(index[lane])), 0, last) * stride;
    }
};

/// Where all lanes hold the same offset, that offset; otherwise -1.
template <class I>
I common_offset(const I* offsets) {
    I differences = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) differences |= offsets[lane] ^ offsets[0];
    return differences == 0 ? offsets[0] : -1;
}

constexpr auto kLoadEach = []<class T>(const Operation& operation, Registers<T>& registers) {
    const Int<T>* offsets = registers.ints(operation.operands[1]);
    const Int<T> common = common_offset(offsets);
    if (common >= 0) {
        const auto from = operation.operands[0] + static_cast<std::uint32_t>(common);
        return copy_rows(registers, operation.result, from, operation.count);
    }
    for_each_component<Ints>(
        operation, registers, [&](Int<T>* __restrict result, const Int<T>* from, const Int<T>* /*b*/) {
            for (std::size_t lane = 0; lane < kLanes; ++lane)
                result[lane] = from[static_cast<std::size_t>(offsets[lane]) * kLanes + lane];
        });
};

constexpr auto kStoreEach = []<class T>(const Operation& operation, Registers<T>& registers) {
    const Int<T>* offsets = registers.ints(operation.operands[1]);
    for_each_component<Ints>(operation, registers, [&](Int<T>* to, const Int<T>* value, const Int<T>* /*b*/) {
        for (std::size_t lane = 0; lane < kLanes; ++lane)
            if (registers.is_active(lane))
                to[static_cast<std::size_t>(offsets[lane]) * kLanes + lane] = value[lane];
    });
};

/// Words: pairs of a first slot and a count, put one after the other.
constexpr auto kConstruct = [](const Operation& operation, auto& registers) {
    const std::uint32_t* words = registers.words(operation);
    std::uint32_t to = operation.result;
    for (std::uint32_t at = 0; at < operation.extras; at += 2) {
        copy_rows(registers, to, words[at], words[at + 1]);
        to += words[at + 1];
    }
};

/// Words: a slot for each component.
constexpr auto kShuffle = [](const Operation& operation, auto& registers) {
    for (std::uint32_t component = 0; component < operation.count; ++component)
        copy_rows(registers, operation.result + component, registers.words(operation)[component], 1);
};

/// Operands: the part, the whole. Words: where in the whole, and the part's slots.
constexpr auto kInsert = [](const Operation& operation, auto& registers) {
    copy_rows(registers, operation.result, operation.operands[1], operation.count);
    const std::uint32_t* words = registers.words(operation);
    copy_rows(registers, operation.result + words[0], operation.operands[0], words[1]);
};

/// The index in a slot, clamped to the vector's components, which the words tell.
template <class T>
std::uint32_t clamped(const Operation& operation, Registers<T>& registers, std::uint32_t slot,
                      std::size_t lane) {
    const auto last = static_cast<std::int32_t>(registers.words(operation)[0]) - 1;
    return static_cast<std::uint32_t>(std::clamp(to_signed(registers.ints(slot)[lane]), 0, last));
}

constexpr auto kExtractDynamic = [](const Operation& operation, auto& registers) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::uint32_t index = clamped(operation, registers, operation.operands[1], lane);
        registers.ints(operation.result)[lane] = registers.ints(operation.operands[0] + index)[lane];
    }
};

constexpr auto kInsertDynamic = [](const Operation& operation, auto& registers) {
    copy_rows(registers, operation.result, operation.operands[0], operation.count);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const std::uint32_t index = clamped(operation, registers, operation.operands[2], lane);
        registers.ints(operation.result + index)[lane] = registers.ints(operation.operands[1])[lane];
    }
};

constexpr Row kRows[] = {
    {GOBO_CORE(Load), Kind::load, "", kRun<kCopyAll>},
    {GOBO_CORE(Store), Kind::store, "", kRun<kCopyActive>},
    {GOBO_CORE(CompositeExtract), Kind::move, "", kRun<kCopyAll>},
    {GOBO_CORE(CompositeConstruct), Kind::move, "", kRun<kConstruct>},
    {GOBO_CORE(CompositeInsert), Kind::move, "", kRun<kInsert>},
    {GOBO_CORE(VectorShuffle), Kind::move, "", kRun<kShuffle>},
    {GOBO_CORE(VectorExtractDynamic), Kind::move, "", kRun<kExtractDynamic>},
    {GOBO_CORE(VectorInsertDynamic), Kind::move, "", kRun<kInsertDynamic>},
    {GOBO_CORE(AccessChain), Kind::move, "", kRun<kAddress>},
    {kCopy, "", Kind::move, "", kRun<kCopyActive>, {}, true},
    {kGather, "Load", Kind::load, "", kRun<kLoadEach>},
    {kScatter, "Store", Kind::store, "", kRun<kStoreEach>},
};

}  // namespace

constinit const std::span<const Row> kMemoryRows = kRows;

}  // namespace gobo::evaluate
