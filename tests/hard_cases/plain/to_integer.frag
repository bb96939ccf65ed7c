#version 450
// A texel's index, of a coordinate scaled far too much.
layout(location = 0) in float coordinate;
layout(location = 0) out vec4 color;

void main() {
    int texel = int(coordinate * 1e9);  // trap: conversion to int out of range
    color = vec4(float(texel));
}
