#include "lab/prove/ranges.hpp"

#include <algorithm>

namespace gobo::prove {
std::uint32_t common_context(const std::vector<Context>& contexts, std::uint32_t a, std::uint32_t b) {
    while (a != b) {
        if (contexts[a].depth < contexts[b].depth) std::swap(a, b);
        a = contexts[a].parent;
    }
    return a;
}

bool is_within(const std::vector<Context>& contexts, std::uint32_t inner, std::uint32_t outer) {
    while (contexts[inner].depth > contexts[outer].depth) inner = contexts[inner].parent;
    return inner == outer;
}

void Ranges::grow() {
    const std::size_t count = expressions_.all.size();
    const std::size_t before = users_.size();
    if (before == count) return;
    known_.resize(count);
    whole_.resize(count, kNothing);
    is_computed_.resize(count, false);
    is_waiting_.resize(count, false);
    cut_of_.resize(count, -1);
    users_.resize(count);
    for (std::size_t index = before; index < count; ++index)
        for (std::uint32_t at = 0; at < expressions_.all[index].count; ++at) {
            std::vector<std::uint32_t>& users =
                users_[expressions_.operand(static_cast<std::uint32_t>(index), at)];
            if (users.empty() || users.back() != index) users.push_back(static_cast<std::uint32_t>(index));
        }
}

void Ranges::begin(const std::vector<Cut>& cuts, const std::vector<bool>* is_wanted) {
    grow();
    wanted_ = is_wanted;
    std::fill(is_computed_.begin(), is_computed_.end(), false);
    for (const Cut& cut : cuts_) cut_of_[cut.expression] = -1;
    cuts_ = cuts;
    // Several cuts of one expression count together.
    for (std::size_t i = 0; i < cuts_.size(); ++i) {
        std::int32_t& index = cut_of_[cuts_[i].expression];
        if (index >= 0)
            cuts_[static_cast<std::size_t>(index)].range =
                both(cuts_[static_cast<std::size_t>(index)].range, cuts_[i].range);
        else
            index = static_cast<std::int32_t>(i);
    }
    frames_ = {{0, 0, 0, true}};
    saved_.clear();
    orders_.clear();
    reached_.assign(expressions_.contexts.size(), false);
    reached_[0] = true;
    is_reached_ = true;
}

void Ranges::compute(std::uint32_t expression) {
    grow();
    Known& known = known_[expression];
    is_computed_[expression] = true;
    if (!is_reached_) {
        known = {};
        return;
    }
    known = evaluate(expression);
    if (const std::int32_t cut = cut_of_[expression]; cut >= 0)
        known.range = both(known.range, cuts_[static_cast<std::size_t>(cut)].range);
    if (cuts_.empty() && frames_.back().context == 0) whole_[expression] = known.range;
    if (!known.range.is_empty()) return;
    is_reached_ = false;
    reached_[frames_.back().context] = false;
}

Range Ranges::across_pixels(std::uint32_t expression) const {
    if (expressions_.all[expression].code == kConstant) return known_[expression].range;
    return whole_[expression].is_empty() ? kAnything : whole_[expression];
}

void Ranges::enter(std::uint32_t context) {
    if (reached_.size() < expressions_.contexts.size()) reached_.resize(expressions_.contexts.size(), false);
    const std::uint32_t current = frames_.back().context;
    if (current == context) return;
    leave_to(common_context(expressions_.contexts, current, context));
    push(context);
}

void Ranges::leave_to(std::uint32_t context) {
    while (frames_.back().context != context) {
        const Frame frame = frames_.back();
        frames_.pop_back();
        while (saved_.size() > frame.saved) {
            known_[saved_.back().expression] = saved_.back().known;
            saved_.pop_back();
        }
        orders_.resize(frame.orders);
        is_reached_ = frame.was_reached;
    }
    is_reached_ = is_reached_ && reached_[context];
}

void Ranges::push(std::uint32_t context) {
    if (frames_.back().context == context) return;
    const Context& entered = expressions_.contexts[context];
    push(entered.parent);
    frames_.push_back({context, saved_.size(), orders_.size(), is_reached_});
    work_ = 0;
    if (is_reached_) is_reached_ = assume(entered.condition, entered.is_true) && spread();
    reached_[context] = is_reached_;
}

bool Ranges::excludes(const std::vector<Cut>& assumptions) {
    if (!is_reached_) return true;
    const std::size_t saved = saved_.size();
    const std::size_t orders = orders_.size();
    work_ = 0;
    bool is_possible = true;
    for (const Cut& assumption : assumptions)
        is_possible = is_possible && narrow(assumption.expression, assumption.range);
    is_possible = is_possible && spread();
    for (const std::uint32_t waiting : waiting_) is_waiting_[waiting] = false;
    waiting_.clear();
    while (saved_.size() > saved) {
        known_[saved_.back().expression] = saved_.back().known;
        saved_.pop_back();
    }
    orders_.resize(orders);
    return !is_possible;
}

}  // namespace gobo::prove
