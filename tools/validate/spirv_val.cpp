#include "validate/spirv_val.hpp"

#include <fmt/format.h>
#include <spirv-tools/libspirv.hpp>

namespace gobo {

Diagnostics spirv_val(const SpirvModule& module, const Place& place) {
    Diagnostics found;
    spvtools::SpirvTools tools(SPV_ENV_OPENGL_4_5);
    tools.SetMessageConsumer(
        [&](spv_message_level_t level, const char*, const spv_position_t& position, const char* message) {
            if (level > SPV_MSG_ERROR) return;
            Diagnostic diagnostic;
            diagnostic.fault = Fault::internal;  // glslang made the module
            diagnostic.place = place;
            diagnostic.message = fmt::format("spirv-val: {} (instruction {})", message, position.index);
            found.push_back(std::move(diagnostic));
        });
    if (!tools.Validate(module) && found.empty()) {
        Diagnostic diagnostic;
        diagnostic.fault = Fault::internal;
        diagnostic.place = place;
        diagnostic.message = "spirv-val refuses the module without saying why";
        found.push_back(std::move(diagnostic));
    }
    return found;
}

}  // namespace gobo
