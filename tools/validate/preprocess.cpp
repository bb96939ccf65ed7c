#include "validate/preprocess.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>

#include "validate/missing_built_ins.hpp"

namespace gobo {

std::optional<std::string> preprocessed(const Composition& composition, const Stage& stage) {
    [[maybe_unused]] static const bool is_initialized = glslang::InitializeProcess();
    const std::string source = is_spirv(composition.dialect)
                                   ? source_of(composition, stage)
                                   : without_foreign_macros(source_of(composition, stage));
    const char* const text = source.data();
    const int length = static_cast<int>(source.size());
    const EShLanguage language = stage.kind == StageKind::vertex ? EShLangVertex : EShLangFragment;
    glslang::TShader shader(language);
    shader.setStringsWithLengths(&text, &length, 1);
    std::string result;
    glslang::TShader::ForbidIncluder no_includes;
    constexpr int kVersionWithout = 110;  // of a source that states none
    if (!shader.preprocess(GetDefaultResources(), kVersionWithout, ENoProfile, false, false,
                           EShMsgOnlyPreprocessor, &result, no_includes))
        return std::nullopt;
    return result;
}

}  // namespace gobo
