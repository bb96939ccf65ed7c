// What OpenGL had built in before 3.1, for families that say `compatibility = true`: in their files `gl_Vertex` is
// read as `legacy_Vertex` and so on, and of these pieces a stage takes those whose name it mentions.
// Source: The OpenGL Shading Language 1.20, sections 7.1 to 7.6 and 8.7.

#piece ModelViewMatrix
uniform mat4 legacy_ModelViewMatrix;

#piece ModelViewMatrixInverse
uniform mat4 legacy_ModelViewMatrixInverse;

#piece ProjectionMatrix
uniform mat4 legacy_ProjectionMatrix;

#piece ProjectionMatrixInverse
uniform mat4 legacy_ProjectionMatrixInverse;

#piece ModelViewProjectionMatrix
uniform mat4 legacy_ModelViewProjectionMatrix;

#piece ModelViewProjectionMatrixInverse
uniform mat4 legacy_ModelViewProjectionMatrixInverse;

#piece NormalMatrix
uniform mat3 legacy_NormalMatrix;

#piece TextureMatrix
uniform mat4 legacy_TextureMatrix[8];

#piece in
#if __VERSION__ >= 130
#define LEGACY_IN in
#define LEGACY_OUT out
#else
#define LEGACY_IN attribute
#define LEGACY_OUT varying
#endif

#piece in.frag
#if __VERSION__ >= 130
#define LEGACY_IN in
#else
#define LEGACY_IN varying
#endif

#piece Vertex
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_Vertex;

#piece Normal
#include "compatibility/in.glsl"
LEGACY_IN vec3 legacy_Normal;

#piece Color
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_Color;

#piece SecondaryColor
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_SecondaryColor;

#piece FogCoord
#include "compatibility/in.glsl"
LEGACY_IN float legacy_FogCoord;

#piece MultiTexCoord0
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_MultiTexCoord0;

#piece MultiTexCoord1
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_MultiTexCoord1;

#piece MultiTexCoord2
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_MultiTexCoord2;

#piece MultiTexCoord3
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_MultiTexCoord3;

#piece FrontColor
#include "compatibility/in.glsl"
LEGACY_OUT vec4 legacy_FrontColor;

#piece FrontColor.frag
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_FrontColor;

#piece FrontSecondaryColor
#include "compatibility/in.glsl"
LEGACY_OUT vec4 legacy_FrontSecondaryColor;

#piece FrontSecondaryColor.frag
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_FrontSecondaryColor;

#piece TexCoord
#include "compatibility/in.glsl"
LEGACY_OUT vec4 legacy_TexCoord[8];

#piece TexCoord.frag
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_TexCoord[8];

#piece FogFragCoord
#include "compatibility/in.glsl"
LEGACY_OUT float legacy_FogFragCoord;

#piece FogFragCoord.frag
#include "compatibility/in.glsl"
LEGACY_IN float legacy_FogFragCoord;

#piece FragColor
#if __VERSION__ >= 130
out vec4 legacy_FragColor;
#else
#define legacy_FragColor gl_FragColor
#endif

#piece FragData
#if __VERSION__ >= 130
out vec4 legacy_FragData[8];
#else
#define legacy_FragData gl_FragData
#endif

#piece LightSource
struct legacy_LightSourceParameters {
    vec4 ambient;
    vec4 diffuse;
    vec4 specular;
    vec4 position;
    vec4 halfVector;
    vec3 spotDirection;
    float spotExponent;
    float spotCutoff;
    float spotCosCutoff;
    float constantAttenuation;
    float linearAttenuation;
    float quadraticAttenuation;
};
uniform legacy_LightSourceParameters legacy_LightSource[8];

#piece LightModel
struct legacy_LightModelParameters {
    vec4 ambient;
};
uniform legacy_LightModelParameters legacy_LightModel;

#piece material
struct legacy_MaterialParameters {
    vec4 emission;
    vec4 ambient;
    vec4 diffuse;
    vec4 specular;
    float shininess;
};

#piece FrontMaterial
#include "compatibility/material.glsl"
uniform legacy_MaterialParameters legacy_FrontMaterial;

#piece BackMaterial
#include "compatibility/material.glsl"
uniform legacy_MaterialParameters legacy_BackMaterial;

#piece FrontLightModelProduct
struct legacy_LightModelProducts {
    vec4 sceneColor;
};
uniform legacy_LightModelProducts legacy_FrontLightModelProduct;

#piece FrontLightProduct
struct legacy_LightProducts {
    vec4 ambient;
    vec4 diffuse;
    vec4 specular;
};
uniform legacy_LightProducts legacy_FrontLightProduct[8];

#piece Fog
struct legacy_FogParameters {
    vec4 color;
    float density;
    float start;
    float end;
    float scale;
};
uniform legacy_FogParameters legacy_Fog;

#piece ftransform
#include "compatibility/ModelViewProjectionMatrix.glsl"
#include "compatibility/Vertex.glsl"
#define ftransform() (legacy_ModelViewProjectionMatrix * legacy_Vertex)

#piece attribute
#if __VERSION__ >= 300
#define attribute in
#endif

#piece varying
#if __VERSION__ >= 300
#define varying out
#endif

#piece varying.frag
#if __VERSION__ >= 300
#define varying in
#endif

#piece texture1D
#if __VERSION__ >= 130
#define texture1D texture
#endif

#piece texture2D
#if __VERSION__ >= 130
#define texture2D texture
#endif

#piece texture3D
#if __VERSION__ >= 130
#define texture3D texture
#endif

#piece textureCube
#if __VERSION__ >= 130
#define textureCube texture
#endif

#piece texture2DProj
#if __VERSION__ >= 130
#define texture2DProj textureProj
#endif

#piece texture2DLod
#if __VERSION__ >= 130
#define texture2DLod textureLod
#endif

#piece textureCubeLod
#if __VERSION__ >= 130
#define textureCubeLod textureLod
#endif

#piece shadow2D
#if __VERSION__ >= 130
#define shadow2D(map, place) vec4(texture(map, place))
#endif

#piece shadow2DProj
#if __VERSION__ >= 130
#define shadow2DProj(map, place) vec4(textureProj(map, place))
#endif
