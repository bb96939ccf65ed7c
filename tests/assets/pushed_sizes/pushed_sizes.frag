struct Tone { float gain; };
struct Ray { vec3 from; float to; vec2 width; };
#if SHAPE == 0
layout(push_constant) uniform BehindOthers { layout(offset = 4) float value; } pushed;
#elif SHAPE == 1
layout(push_constant) uniform OneStruct { Tone tone; } pushed;
#elif SHAPE == 2
layout(push_constant) uniform FarApart { float value; layout(offset = 120) float last; } pushed;
#elif SHAPE == 3
layout(push_constant) uniform EndsInVector { float value; vec3 last; } pushed;
#elif SHAPE == 4
layout(push_constant) uniform Rows { layout(row_major) mat2x3 rows; float value; } pushed;
#elif SHAPE == 5
layout(push_constant) uniform Doubles { double first; float value; } pushed;
#elif SHAPE == 6
layout(push_constant) uniform Rays { Ray rays[2]; float value; } pushed;
#elif SHAPE == 7
layout(push_constant, std140) uniform Std140 { mat2 turn; float values[2]; } pushed;
#elif SHAPE == 8
layout(push_constant) uniform Whole { mat4 turn, back; } pushed;
#endif
OUTPUT(0) vec4 color;
void main() {
#if SHAPE == 1
    color = vec4(pushed.tone.gain);
#elif SHAPE == 7
    color = vec4(pushed.values[1]);
#elif SHAPE == 8
    color = pushed.turn * pushed.back[0];
#else
    color = vec4(pushed.value);
#endif
}
