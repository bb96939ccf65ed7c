#include "lab/oracle/reflectance_extensions.hpp"

namespace gobo::oracle {

const std::vector<ReflectanceExtension>& reflectance_extensions() {
    static const std::vector<ReflectanceExtension> kExtensions = {};
    return kExtensions;
}

std::vector<ExtensionNumber> extension_numbers() {
    std::vector<ExtensionNumber> numbers;
    for (const ReflectanceExtension& extension : reflectance_extensions())
        numbers.insert(numbers.end(), extension.numbers.begin(), extension.numbers.end());
    return numbers;
}

std::vector<double> numbers_of(const std::vector<double>& of_all, std::size_t place) {
    const std::vector<ReflectanceExtension>& all = reflectance_extensions();
    std::size_t first = 0;
    for (std::size_t i = 0; i < place; ++i) first += all[i].numbers.size();
    std::vector<double> numbers(all[place].numbers.size());
    for (std::size_t i = 0; i < numbers.size() && first + i < of_all.size(); ++i)
        numbers[i] = of_all[first + i];
    return numbers;
}

}  // namespace gobo::oracle
