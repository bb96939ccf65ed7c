// The interface of a program as applications see it: blocks, uniforms, samplers, inputs and outputs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gobo {

/// A member of a uniform block or struct. Offsets, sizes and strides are in bytes.
struct Member {
    std::string name;
    std::string type;        ///< GLSL name: "vec3", "mat4", "bool", or the struct's name
    int offset = 0;          ///< from the start of what contains it (block or struct)
    std::vector<int> array;  ///< extents, outermost first; empty where it is no array
    int array_stride = 0;    ///< of the outermost dimension; 0 where it is no array
    int matrix_stride = 0;   ///< 0 where it is no matrix
    bool row_major = false;
    std::vector<Member> members;  ///< of a struct

    friend bool operator==(const Member&, const Member&) = default;
};

/// A uniform block, laid out by std140 unless it says otherwise.
struct Block {
    std::string name;                 ///< of the block, not of its instance; "Name[1]" in an array of blocks
    int binding = -1;                 ///< -1 where the source states none
    int size = 0;                     ///< bytes, as OpenGL reports UNIFORM_BLOCK_DATA_SIZE
    std::vector<std::string> stages;  ///< "vertex", "fragment", sorted as the pipeline runs
    std::vector<Member> members;

    friend bool operator==(const Block&, const Block&) = default;
};

/// A uniform outside any block.
struct Uniform {
    std::string name;
    std::string type;
    int location = -1;  ///< -1 where the source states none
    std::vector<int> array;
    std::vector<Member> members;  ///< of a struct (offsets are meaningless and 0)
    std::vector<std::string> stages;

    friend bool operator==(const Uniform&, const Uniform&) = default;
};

struct Sampler {
    std::string name;
    std::string type;  ///< "sampler2DArrayShadow"
    int binding = -1;
    std::vector<int> array;
    std::vector<std::string> stages;

    friend bool operator==(const Sampler&, const Sampler&) = default;
};

/// A vertex attribute, a fragment output, or a value between the stages.
struct Variable {
    std::string
        name;  ///< in a block or struct the path, as OpenGL spells it: "Surface.normal", "ray[1].origin"
    std::string type;
    int location = -1;
    std::vector<int> array;

    friend bool operator==(const Variable&, const Variable&) = default;
};

/// Of one stage, or of a linked program. Each list is sorted by name.
struct Interface {
    std::vector<std::string> stages;
    std::vector<Block> blocks;          ///< uniform blocks
    std::vector<Block> storage_blocks;  ///< shader storage blocks; a last array without a size has extent 0
    std::vector<Uniform> uniforms;
    std::vector<Sampler> samplers;
    std::vector<Variable> inputs;   ///< of the first stage
    std::vector<Variable> outputs;  ///< of the last stage

    friend bool operator==(const Interface&, const Interface&) = default;
};

}  // namespace gobo
