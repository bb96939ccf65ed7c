#include "evaluate_support.hpp"

#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <gtest/gtest.h>
#if __has_include(<glslang/Public/ResourceLimits.h>)
#include <glslang/Public/ResourceLimits.h>
#endif

namespace gobo::evaluate {

std::vector<std::uint32_t> compile(ShaderStage stage, const std::string& source) {
    static const bool started = glslang::InitializeProcess();
    EXPECT_TRUE(started);
    const EShLanguage language = stage == ShaderStage::vertex ? EShLangVertex : EShLangFragment;
    glslang::TShader shader(language);
    const char* text = source.c_str();
    const int length = static_cast<int>(source.size());
    const char* name = "test.glsl";
    shader.setStringsWithLengthsAndNames(&text, &length, &name, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientOpenGL, 100);
    shader.setEnvClient(glslang::EShClientOpenGL, glslang::EShTargetOpenGL_450);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
    shader.setAutoMapLocations(true);
    shader.setAutoMapBindings(true);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules);
    const bool is_parsed = shader.parse(GetDefaultResources(), 450, false, messages);
    EXPECT_TRUE(is_parsed) << shader.getInfoLog() << source;
    if (!is_parsed) return {};
    glslang::TProgram linked;
    linked.addShader(&shader);
    EXPECT_TRUE(linked.link(messages) && linked.mapIO()) << linked.getInfoLog();
    std::vector<std::uint32_t> words;
    glslang::SpvOptions options;
    options.generateDebugInfo = true;
    options.disableOptimizer = true;
    glslang::GlslangToSpv(*linked.getIntermediate(language), words, &options);
    return words;
}

Program program_of(ShaderStage stage, const std::string& source) {
    Result<Program> program = decode(compile(stage, source));
    EXPECT_TRUE(program) << to_text(program.error().front()) << source;
    return program ? *std::move(program) : Program{};
}

Program fragment_of(const std::string& body, const std::string& declarations) {
    return program_of(ShaderStage::fragment, R"(#version 450
layout(location = 0) in vec4 a;
layout(location = 1) in vec4 b;
layout(location = 2) in vec4 c;
layout(location = 0) out vec4 r;
)" + declarations + "\nvoid main() {\n" + body + "\n}\n");
}

template <class T>
std::vector<double> output_of(const Program& program,
                              const std::map<std::string, std::vector<double>, std::less<>>& values,
                              const std::string& output) {
    Invocations invocations;
    invocations.values = values;
    const Result<Outputs> outputs = run<T>(program, invocations);
    EXPECT_TRUE(outputs) << to_text(outputs.error().front());
    if (!outputs) return {};
    const auto found = outputs->values.find(output);
    EXPECT_NE(found, outputs->values.end()) << output;
    return found == outputs->values.end() ? std::vector<double>{} : found->second;
}

template std::vector<double> output_of<float>(const Program&,
                                              const std::map<std::string, std::vector<double>, std::less<>>&,
                                              const std::string&);
template std::vector<double> output_of<double>(const Program&,
                                               const std::map<std::string, std::vector<double>, std::less<>>&,
                                               const std::string&);

}  // namespace gobo::evaluate
