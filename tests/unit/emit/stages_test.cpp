// The header of a family whose programs have other stages than the usual two, on a real driver: each program
// links with its own stages, no two samplers share a unit, and the compute program runs.
#include <set>

#include <gtest/gtest.h>

#define GOBO_GL_NO_LOADER
#include <gobo/gl.hpp>

#include "lab/render/context.hpp"
#include "stages.hpp"

namespace gobo {
namespace {

TEST(ProgramsOfOneFamily, HaveTheKeysAndStagesThatTheyNameAndLink) {
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const GladGLContext& functions = context->gl();
    std::string all;
    for (const stages::Permutation& permutation : stages::permutations) {
        all += stages::key_text(permutation.key()) + ":";
        runtime::for_each_stage(permutation, [&](runtime::StageKind kind, const stages::Stage& stage) {
            all += " " + std::string(runtime::name_of(kind));
            EXPECT_GT(stage.piece_count(), 0);
        });
        all += "\n";
        SCOPED_TRACE(stages::key_text(permutation.key()));
        const gl::Program program = gl::build_program(permutation, functions);
        ASSERT_TRUE(program) << program.error;
        std::set<GLint> units;
        for (const runtime::SamplerBinding& sampler : stages::samplers) {
            const GLint location =
                functions.GetUniformLocation(program.id, std::string(sampler.name).c_str());
            if (location < 0) continue;
            GLint unit = -1;
            functions.GetUniformiv(program.id, location, &unit);
            EXPECT_EQ(unit, sampler.binding);
            EXPECT_TRUE(units.insert(unit).second) << sampler.name << " shares its unit";
        }
        EXPECT_EQ(functions.GetError(), static_cast<GLenum>(GL_NO_ERROR));
        functions.DeleteProgram(program.id);
    }
    EXPECT_EQ(all,
              "default: vertex fragment\n"
              "lifted=on: vertex fragment\n"
              "program=curved: vertex tess_control tess_evaluation fragment\n"
              "lifted=on program=curved: vertex tess_control tess_evaluation fragment\n"
              "program=depth: vertex\n"
              "lifted=on program=depth: vertex\n"
              "program=outlined: vertex geometry fragment\n"
              "lifted=on program=outlined: vertex geometry fragment\n"
              "program=twice: compute\n"
              "striped=on: vertex fragment\n"
              "lifted=on striped=on: vertex fragment\n"
              "program=curved striped=on: vertex tess_control tess_evaluation fragment\n"
              "lifted=on program=curved striped=on: vertex tess_control tess_evaluation fragment\n");
    EXPECT_EQ(stages::find(stages::Key{})->geometry.piece_count(), 0);
    EXPECT_EQ(stages::outputs.size(), 1U);  // those of the program without a fragment stage are no outputs
}

TEST(ProgramsOfOneFamily, Compute) {
    const Result<Context> context = open_context(Backend::osmesa);
    ASSERT_TRUE(context) << to_text(context.error().front());
    const GladGLContext& functions = context->gl();
    stages::Key key;
    key.program = stages::Program::twice;
    const gl::Program program = gl::build_program(*stages::find(key), functions);
    ASSERT_TRUE(program) << program.error;
    std::array<float, 8> values = {1, 2, 3, 4, 5, 6, 7, 8};
    GLuint buffer = 0;
    functions.GenBuffers(1, &buffer);
    functions.BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffer);
    functions.BufferData(GL_SHADER_STORAGE_BUFFER, sizeof values, values.data(), GL_STATIC_DRAW);
    functions.UseProgram(program.id);
    functions.DispatchCompute(2, 1, 1);
    functions.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    functions.GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof values, values.data());
    EXPECT_EQ(values, (std::array<float, 8>{2, 4, 6, 8, 10, 12, 14, 16}));
    functions.DeleteBuffers(1, &buffer);
    functions.DeleteProgram(program.id);
}

}  // namespace
}  // namespace gobo
