// An application of many families, whose names C++ or its libraries have already.
#include "families.hpp"

int main() {
    const bool are_found = main_::find(main_::Key{}) != nullptr && std_::find(std_::Key{}) != nullptr &&
                           log_::find(log_::Key{}) != nullptr && tm_::find(tm_::Key{}) != nullptr &&
                           INT_MAX_::find(INT_MAX_::Key{}) != nullptr && _4x::find(_4x::Key{}) != nullptr &&
                           attribute::find(attribute::Key{}) != nullptr;
    return are_found ? 0 : 1;
}
