#include "reflect_compile.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <gtest/gtest.h>

#include "reflect/reflect.hpp"

namespace gobo::testing {
namespace {

GlTypes types_of(glslang::TProgram& program) {
    GlTypes types;
    // Without the second option, blocks that nothing reads are left out.
    program.buildReflection(EShReflectionAllBlockVariables | EShReflectionSharedStd140UBO);
    for (int i = 0; i < program.getNumUniformVariables(); ++i) {
        const glslang::TObjectReflection& uniform = program.getUniform(i);
        types[uniform.name] = uniform.glDefineType;
    }
    return types;
}

}  // namespace

Compiled compile(Stage stage, const std::string& source) {
    glslang::InitializeProcess();
    const EShLanguage language = stage == Stage::vertex ? EShLangVertex : EShLangFragment;
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules);
    const char* const text = source.c_str();
    glslang::TShader shader(language);
    shader.setStrings(&text, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientOpenGL, 450);
    shader.setEnvClient(glslang::EShClientOpenGL, glslang::EShTargetOpenGL_450);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
    shader.setAutoMapLocations(true);
    shader.setAutoMapBindings(true);
    Compiled compiled;
    if (!shader.parse(GetDefaultResources(), 450, false, messages)) {
        compiled.log = shader.getInfoLog();
        return compiled;
    }
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages) || !program.mapIO()) {
        compiled.log = program.getInfoLog();
        return compiled;
    }
    compiled.types = types_of(program);
    glslang::GlslangToSpv(*program.getIntermediate(language), compiled.spirv);
    return compiled;
}

Interface interface_of_stage(Stage stage, const std::string& source) {
    const Compiled compiled = compile(stage, source);
    EXPECT_EQ(compiled.log, "");
    return restore_bools(reflect_stage(compiled.spirv).value_or(Interface{}), compiled.types);
}

}  // namespace gobo::testing
