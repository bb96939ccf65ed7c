// bare_glslang THREADS FILES... (- for a list of them on standard input): parses, links, reflects each stage
// and makes its SPIR-V, through glslang and nothing else: the least that any validator built on it can take.
// The yardstick for gobo check.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

namespace {

std::string read(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool validate(const std::string& path) {
    const EShLanguage language = path.ends_with(".vert") ? EShLangVertex : EShLangFragment;
    const std::string source = read(path);
    const char* text = source.c_str();
    glslang::TShader shader(language);
    shader.setStrings(&text, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientOpenGL, 100);
    shader.setEnvClient(glslang::EShClientOpenGL, glslang::EShTargetOpenGL_450);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_0);
    const auto rules = static_cast<EShMessages>(EShMsgSpvRules);
    if (!shader.parse(GetDefaultResources(), 110, false, rules)) return false;
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(rules) || !program.buildReflection(EShReflectionAllBlockVariables)) return false;
    std::vector<unsigned> spirv;
    glslang::SpvOptions options;
    options.disableOptimizer = true;
    glslang::GlslangToSpv(*program.getIntermediate(language), spirv, &options);
    return !spirv.empty();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    std::vector<std::string> paths(argv + 2, argv + argc);
    if (paths.front() == "-") {
        paths.clear();
        for (std::string path; std::getline(std::cin, path);) paths.push_back(path);
    }
    glslang::InitializeProcess();
    std::atomic<std::size_t> next = 0;
    std::atomic<bool> is_fine = true;
    const auto work = [&] {
        for (std::size_t i = next++; i < paths.size(); i = next++) {
            if (!validate(paths[i])) is_fine = false;
        }
    };
    // The first alone: it builds glslang's tables for the version, which the threads then share.
    is_fine = validate(paths[next++]);
    {
        std::vector<std::jthread> threads;
        for (int i = 1; i < std::atoi(argv[1]); ++i) threads.emplace_back(work);
        work();
    }
    if (!is_fine) std::fputs("bare_glslang: a stage has errors\n", stderr);
    return is_fine ? 0 : 1;
}
