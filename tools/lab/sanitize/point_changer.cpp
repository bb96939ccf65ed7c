#include "lab/sanitize/point_changer.hpp"

#include <algorithm>
#include <cmath>

#include "lab/sanitize/input_range.hpp"

namespace gobo::sanitize {

PointChanger::PointChanger(const InputSpace& space) : space_(space) {
    for (std::size_t field = 0; field < space.fields.size(); ++field)
        field_of_.insert(field_of_.end(), space.fields[field].components, field);
}

/// Changes one number, or all of its field; returns the number.
std::size_t PointChanger::change(std::span<double> point, std::size_t number, Random& random) const {
    const InputField& field = space_.fields[field_of_[number]];
    const std::span<double> numbers = point.subspan(field.first, field.components);
    if (field.components > 1 && random.one_in(8)) {
        const double factor = random.one_in(4) ? -1 : std::exp2(random.between(-8, 8));
        for (double& component : numbers) component *= factor;
    } else {
        point[number] = changed_number(point, field, point[number], random);
    }
    bring_into_domain(field, numbers);
    return number;
}

double PointChanger::changed_number(std::span<const double> point, const InputField& field, double number,
                                    Random& random) const {
    const double sign = random.one_in(2) ? 1 : -1;
    switch (random.index(8)) {
        case 0:
            return random.pick(field.hard);
        case 1:
            return ordinary_number(field.domain, random);
        case 2:  // a few roundings away
            return number * (1 + sign * static_cast<double>(1 + random.index(3)) * 0x1p-23);
        case 3:  // some other number of the point
            return sign * point[random.index(point.size())];
        case 4:
            return number + sign * (field.domain.high - field.domain.low) * std::exp2(random.between(-30, 0));
        case 5:
            return -number;
        default:
            return number + sign * std::max(std::abs(number), 1.0) * std::exp2(random.between(-24, 1));
    }
}

}  // namespace gobo::sanitize
