// Tables as text; core/csv.hpp reads them.
#pragma once

#include <string>

#include "core/csv.hpp"

namespace gobo::study {

/// RFC 4180, a header line, '\n'.
[[nodiscard]] std::string csv_text(const CsvTable& table);

}  // namespace gobo::study
