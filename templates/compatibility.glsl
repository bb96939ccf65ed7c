// What OpenGL had built in before 3.1, for families that say `compatibility = true`: in their files `gl_Vertex` is
// read as `legacy_Vertex` and so on, and of these pieces a stage takes those whose name it mentions.
// Lookups are functions, since a variable may be called `texture`.
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

#piece ModelViewMatrixTranspose
uniform mat4 legacy_ModelViewMatrixTranspose;

#piece ModelViewMatrixInverseTranspose
uniform mat4 legacy_ModelViewMatrixInverseTranspose;

#piece ProjectionMatrixTranspose
uniform mat4 legacy_ProjectionMatrixTranspose;

#piece ProjectionMatrixInverseTranspose
uniform mat4 legacy_ProjectionMatrixInverseTranspose;

#piece ModelViewProjectionMatrixTranspose
uniform mat4 legacy_ModelViewProjectionMatrixTranspose;

#piece ModelViewProjectionMatrixInverseTranspose
uniform mat4 legacy_ModelViewProjectionMatrixInverseTranspose;

#piece NormalMatrix
uniform mat3 legacy_NormalMatrix;

#piece NormalScale
uniform float legacy_NormalScale;

#piece TextureMatrix
uniform mat4 legacy_TextureMatrix[8];

#piece TextureMatrixInverse
uniform mat4 legacy_TextureMatrixInverse[8];

#piece TextureMatrixTranspose
uniform mat4 legacy_TextureMatrixTranspose[8];

#piece TextureMatrixInverseTranspose
uniform mat4 legacy_TextureMatrixInverseTranspose[8];

#piece EyePlaneS
uniform vec4 legacy_EyePlaneS[8];

#piece EyePlaneT
uniform vec4 legacy_EyePlaneT[8];

#piece EyePlaneR
uniform vec4 legacy_EyePlaneR[8];

#piece EyePlaneQ
uniform vec4 legacy_EyePlaneQ[8];

#piece ObjectPlaneS
uniform vec4 legacy_ObjectPlaneS[8];

#piece ObjectPlaneT
uniform vec4 legacy_ObjectPlaneT[8];

#piece ObjectPlaneR
uniform vec4 legacy_ObjectPlaneR[8];

#piece ObjectPlaneQ
uniform vec4 legacy_ObjectPlaneQ[8];

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
#define LEGACY_IN in highp
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

#piece MultiTexCoord4
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_MultiTexCoord4;

#piece MultiTexCoord5
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_MultiTexCoord5;

#piece MultiTexCoord6
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_MultiTexCoord6;

#piece MultiTexCoord7
#include "compatibility/in.glsl"
LEGACY_IN vec4 legacy_MultiTexCoord7;

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

#piece BackColor
#include "compatibility/in.glsl"
LEGACY_OUT vec4 legacy_BackColor;

#piece BackSecondaryColor
#include "compatibility/in.glsl"
LEGACY_OUT vec4 legacy_BackSecondaryColor;

#piece TextureEnvColor
uniform vec4 legacy_TextureEnvColor[8];

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

#piece FragData
#if __VERSION__ < 130
#define legacy_FragData gl_FragData
#elif defined(GL_ES)
out highp vec4 legacy_FragData[4];
#else
out highp vec4 legacy_FragData[8];
#endif
#define LEGACY_HAS_DATA

#piece FragColor
#if __VERSION__ < 130
#define legacy_FragColor gl_FragColor
#elif defined(LEGACY_HAS_DATA)
#define legacy_FragColor legacy_FragData[0]
#else
out highp vec4 legacy_FragColor;
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

#piece Point
struct legacy_PointParameters {
    float size;
    float sizeMin;
    float sizeMax;
    float fadeThresholdSize;
    float distanceConstantAttenuation;
    float distanceLinearAttenuation;
    float distanceQuadraticAttenuation;
};
uniform legacy_PointParameters legacy_Point;

#piece ClipPlane
uniform vec4 legacy_ClipPlane[8];

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

#piece light_model_products
struct legacy_LightModelProducts {
    vec4 sceneColor;
};

#piece FrontLightModelProduct
#include "compatibility/light_model_products.glsl"
uniform legacy_LightModelProducts legacy_FrontLightModelProduct;

#piece BackLightModelProduct
#include "compatibility/light_model_products.glsl"
uniform legacy_LightModelProducts legacy_BackLightModelProduct;

#piece light_products
struct legacy_LightProducts {
    vec4 ambient;
    vec4 diffuse;
    vec4 specular;
};

#piece FrontLightProduct
#include "compatibility/light_products.glsl"
uniform legacy_LightProducts legacy_FrontLightProduct[8];

#piece BackLightProduct
#include "compatibility/light_products.glsl"
uniform legacy_LightProducts legacy_BackLightProduct[8];

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
highp vec4 legacy_texture1D(sampler1D map, highp float place) { return texture(map, place); }
#define texture1D legacy_texture1D
#endif

#piece texture1D.frag
#if __VERSION__ >= 130
highp vec4 legacy_texture1D(sampler1D map, highp float place) { return texture(map, place); }
highp vec4 legacy_texture1D(sampler1D map, highp float place, highp float bias) { return texture(map, place, bias); }
#define texture1D legacy_texture1D
#endif

#piece texture2D
#if __VERSION__ >= 130
highp vec4 legacy_texture2D(sampler2D map, highp vec2 place) { return texture(map, place); }
#define texture2D legacy_texture2D
#endif

#piece texture2D.frag
#if __VERSION__ >= 130
highp vec4 legacy_texture2D(sampler2D map, highp vec2 place) { return texture(map, place); }
highp vec4 legacy_texture2D(sampler2D map, highp vec2 place, highp float bias) { return texture(map, place, bias); }
#define texture2D legacy_texture2D
#endif

#piece texture3D
#if __VERSION__ >= 130
highp vec4 legacy_texture3D(highp sampler3D map, highp vec3 place) { return texture(map, place); }
#define texture3D legacy_texture3D
#endif

#piece texture3D.frag
#if __VERSION__ >= 130
highp vec4 legacy_texture3D(highp sampler3D map, highp vec3 place) { return texture(map, place); }
highp vec4 legacy_texture3D(highp sampler3D map, highp vec3 place, highp float bias) { return texture(map, place, bias); }
#define texture3D legacy_texture3D
#endif

#piece textureCube
#if __VERSION__ >= 130
highp vec4 legacy_textureCube(samplerCube map, highp vec3 place) { return texture(map, place); }
#define textureCube legacy_textureCube
#endif

#piece textureCube.frag
#if __VERSION__ >= 130
highp vec4 legacy_textureCube(samplerCube map, highp vec3 place) { return texture(map, place); }
highp vec4 legacy_textureCube(samplerCube map, highp vec3 place, highp float bias) { return texture(map, place, bias); }
#define textureCube legacy_textureCube
#endif

#piece texture2DProj
#if __VERSION__ >= 130
highp vec4 legacy_texture2DProj(sampler2D map, highp vec3 place) { return textureProj(map, place); }
highp vec4 legacy_texture2DProj(sampler2D map, highp vec4 place) { return textureProj(map, place); }
#define texture2DProj legacy_texture2DProj
#endif

#piece texture2DProj.frag
#if __VERSION__ >= 130
highp vec4 legacy_texture2DProj(sampler2D map, highp vec3 place) { return textureProj(map, place); }
highp vec4 legacy_texture2DProj(sampler2D map, highp vec3 place, highp float bias) { return textureProj(map, place, bias); }
highp vec4 legacy_texture2DProj(sampler2D map, highp vec4 place) { return textureProj(map, place); }
highp vec4 legacy_texture2DProj(sampler2D map, highp vec4 place, highp float bias) { return textureProj(map, place, bias); }
#define texture2DProj legacy_texture2DProj
#endif

#piece texture2DLod
#if __VERSION__ >= 130
highp vec4 legacy_texture2DLod(sampler2D map, highp vec2 place, highp float lod) { return textureLod(map, place, lod); }
#define texture2DLod legacy_texture2DLod
#endif

#piece textureCubeLod
#if __VERSION__ >= 130
highp vec4 legacy_textureCubeLod(samplerCube map, highp vec3 place, highp float lod) { return textureLod(map, place, lod); }
#define textureCubeLod legacy_textureCubeLod
#endif

#piece shadow2D
#if __VERSION__ >= 130
highp vec4 legacy_shadow2D(highp sampler2DShadow map, highp vec3 place) { return vec4(texture(map, place)); }
#define shadow2D legacy_shadow2D
#endif

#piece shadow2D.frag
#if __VERSION__ >= 130
highp vec4 legacy_shadow2D(highp sampler2DShadow map, highp vec3 place) { return vec4(texture(map, place)); }
highp vec4 legacy_shadow2D(highp sampler2DShadow map, highp vec3 place, highp float bias) { return vec4(texture(map, place, bias)); }
#define shadow2D legacy_shadow2D
#endif

#piece shadow2DProj
#if __VERSION__ >= 130
highp vec4 legacy_shadow2DProj(highp sampler2DShadow map, highp vec4 place) { return vec4(textureProj(map, place)); }
#define shadow2DProj legacy_shadow2DProj
#endif

#piece shadow2DProj.frag
#if __VERSION__ >= 130
highp vec4 legacy_shadow2DProj(highp sampler2DShadow map, highp vec4 place) { return vec4(textureProj(map, place)); }
highp vec4 legacy_shadow2DProj(highp sampler2DShadow map, highp vec4 place, highp float bias) { return vec4(textureProj(map, place, bias)); }
#define shadow2DProj legacy_shadow2DProj
#endif

#piece texture2DLodEXT
#include "compatibility/texture2DLod.glsl"
#if __VERSION__ >= 130
#define texture2DLodEXT texture2DLod
#endif

#piece textureCubeLodEXT
#include "compatibility/textureCubeLod.glsl"
#if __VERSION__ >= 130
#define textureCubeLodEXT textureCubeLod
#endif

#piece texture1DProj
#if __VERSION__ >= 130
highp vec4 legacy_texture1DProj(highp sampler1D map, highp vec2 place) { return textureProj(map, place); }
highp vec4 legacy_texture1DProj(highp sampler1D map, highp vec4 place) { return textureProj(map, place); }
#define texture1DProj legacy_texture1DProj
#endif

#piece texture1DProj.frag
#if __VERSION__ >= 130
highp vec4 legacy_texture1DProj(highp sampler1D map, highp vec2 place) { return textureProj(map, place); }
highp vec4 legacy_texture1DProj(highp sampler1D map, highp vec4 place) { return textureProj(map, place); }
highp vec4 legacy_texture1DProj(highp sampler1D map, highp vec2 place, highp float bias) { return textureProj(map, place, bias); }
highp vec4 legacy_texture1DProj(highp sampler1D map, highp vec4 place, highp float bias) { return textureProj(map, place, bias); }
#define texture1DProj legacy_texture1DProj
#endif

#piece texture3DProj
#if __VERSION__ >= 130
highp vec4 legacy_texture3DProj(highp sampler3D map, highp vec4 place) { return textureProj(map, place); }
#define texture3DProj legacy_texture3DProj
#endif

#piece texture3DProj.frag
#if __VERSION__ >= 130
highp vec4 legacy_texture3DProj(highp sampler3D map, highp vec4 place) { return textureProj(map, place); }
highp vec4 legacy_texture3DProj(highp sampler3D map, highp vec4 place, highp float bias) { return textureProj(map, place, bias); }
#define texture3DProj legacy_texture3DProj
#endif

#piece texture2DRect
#if __VERSION__ >= 140
highp vec4 legacy_texture2DRect(highp sampler2DRect map, highp vec2 place) { return texture(map, place); }
#define texture2DRect legacy_texture2DRect
#endif

#piece texture2DRectProj
#if __VERSION__ >= 140
highp vec4 legacy_texture2DRectProj(highp sampler2DRect map, highp vec3 place) { return textureProj(map, place); }
highp vec4 legacy_texture2DRectProj(highp sampler2DRect map, highp vec4 place) { return textureProj(map, place); }
#define texture2DRectProj legacy_texture2DRectProj
#endif

#piece texture1DLod
#if __VERSION__ >= 130
highp vec4 legacy_texture1DLod(highp sampler1D map, highp float place, highp float lod) { return textureLod(map, place, lod); }
#define texture1DLod legacy_texture1DLod
#endif

#piece texture3DLod
#if __VERSION__ >= 130
highp vec4 legacy_texture3DLod(highp sampler3D map, highp vec3 place, highp float lod) { return textureLod(map, place, lod); }
#define texture3DLod legacy_texture3DLod
#endif

#piece texture1DProjLod
#if __VERSION__ >= 130
highp vec4 legacy_texture1DProjLod(highp sampler1D map, highp vec2 place, highp float lod) { return textureProjLod(map, place, lod); }
highp vec4 legacy_texture1DProjLod(highp sampler1D map, highp vec4 place, highp float lod) { return textureProjLod(map, place, lod); }
#define texture1DProjLod legacy_texture1DProjLod
#endif

#piece texture2DProjLod
#if __VERSION__ >= 130
highp vec4 legacy_texture2DProjLod(sampler2D map, highp vec3 place, highp float lod) { return textureProjLod(map, place, lod); }
highp vec4 legacy_texture2DProjLod(sampler2D map, highp vec4 place, highp float lod) { return textureProjLod(map, place, lod); }
#define texture2DProjLod legacy_texture2DProjLod
#endif

#piece texture3DProjLod
#if __VERSION__ >= 130
highp vec4 legacy_texture3DProjLod(highp sampler3D map, highp vec4 place, highp float lod) { return textureProjLod(map, place, lod); }
#define texture3DProjLod legacy_texture3DProjLod
#endif

#piece shadow1D
#if __VERSION__ >= 130
highp vec4 legacy_shadow1D(highp sampler1DShadow map, highp vec3 place) { return vec4(texture(map, place)); }
#define shadow1D legacy_shadow1D
#endif

#piece shadow1D.frag
#if __VERSION__ >= 130
highp vec4 legacy_shadow1D(highp sampler1DShadow map, highp vec3 place) { return vec4(texture(map, place)); }
highp vec4 legacy_shadow1D(highp sampler1DShadow map, highp vec3 place, highp float bias) { return vec4(texture(map, place, bias)); }
#define shadow1D legacy_shadow1D
#endif

#piece shadow1DProj
#if __VERSION__ >= 130
highp vec4 legacy_shadow1DProj(highp sampler1DShadow map, highp vec4 place) { return vec4(textureProj(map, place)); }
#define shadow1DProj legacy_shadow1DProj
#endif

#piece shadow1DProj.frag
#if __VERSION__ >= 130
highp vec4 legacy_shadow1DProj(highp sampler1DShadow map, highp vec4 place) { return vec4(textureProj(map, place)); }
highp vec4 legacy_shadow1DProj(highp sampler1DShadow map, highp vec4 place, highp float bias) { return vec4(textureProj(map, place, bias)); }
#define shadow1DProj legacy_shadow1DProj
#endif

#piece shadow2DRect
#if __VERSION__ >= 140
highp vec4 legacy_shadow2DRect(highp sampler2DRectShadow map, highp vec3 place) { return vec4(texture(map, place)); }
#define shadow2DRect legacy_shadow2DRect
#endif

#piece shadow2DRectProj
#if __VERSION__ >= 140
highp vec4 legacy_shadow2DRectProj(highp sampler2DRectShadow map, highp vec4 place) { return vec4(textureProj(map, place)); }
#define shadow2DRectProj legacy_shadow2DRectProj
#endif

#piece shadow1DLod
#if __VERSION__ >= 130
highp vec4 legacy_shadow1DLod(highp sampler1DShadow map, highp vec3 place, highp float lod) { return vec4(textureLod(map, place, lod)); }
#define shadow1DLod legacy_shadow1DLod
#endif

#piece shadow1DProjLod
#if __VERSION__ >= 130
highp vec4 legacy_shadow1DProjLod(highp sampler1DShadow map, highp vec4 place, highp float lod) { return vec4(textureProjLod(map, place, lod)); }
#define shadow1DProjLod legacy_shadow1DProjLod
#endif

#piece shadow2DLod
#if __VERSION__ >= 130
highp vec4 legacy_shadow2DLod(highp sampler2DShadow map, highp vec3 place, highp float lod) { return vec4(textureLod(map, place, lod)); }
#define shadow2DLod legacy_shadow2DLod
#endif

#piece shadow2DProjLod
#if __VERSION__ >= 130
highp vec4 legacy_shadow2DProjLod(highp sampler2DShadow map, highp vec4 place, highp float lod) { return vec4(textureProjLod(map, place, lod)); }
#define shadow2DProjLod legacy_shadow2DProjLod
#endif

#piece texture1DGradARB
#if __VERSION__ >= 130
#define texture1DGradARB textureGrad
#endif

#piece texture2DGradARB
#if __VERSION__ >= 130
#define texture2DGradARB textureGrad
#endif

#piece texture3DGradARB
#if __VERSION__ >= 130
#define texture3DGradARB textureGrad
#endif

#piece textureCubeGradARB
#if __VERSION__ >= 130
#define textureCubeGradARB textureGrad
#endif

#piece texture1DProjGradARB
#if __VERSION__ >= 130
#define texture1DProjGradARB textureProjGrad
#endif

#piece texture2DProjGradARB
#if __VERSION__ >= 130
#define texture2DProjGradARB textureProjGrad
#endif

#piece texture3DProjGradARB
#if __VERSION__ >= 130
#define texture3DProjGradARB textureProjGrad
#endif

#piece shadow1DGradARB
#if __VERSION__ >= 130
#define shadow1DGradARB(map, place, dx, dy) vec4(textureGrad(map, place, dx, dy))
#endif

#piece shadow2DGradARB
#if __VERSION__ >= 130
#define shadow2DGradARB(map, place, dx, dy) vec4(textureGrad(map, place, dx, dy))
#endif

#piece shadow1DProjGradARB
#if __VERSION__ >= 130
#define shadow1DProjGradARB(map, place, dx, dy) vec4(textureProjGrad(map, place, dx, dy))
#endif

#piece shadow2DProjGradARB
#if __VERSION__ >= 130
#define shadow2DProjGradARB(map, place, dx, dy) vec4(textureProjGrad(map, place, dx, dy))
#endif
