#!/usr/bin/env bash
# Runs one fuzzer on seeds and words that come from the scenes and the registry:
#
#     cmake --preset fuzz && cmake --build --preset fuzz
#     tests/fuzzing/fuzz.sh config 600        # or another name; seconds
#
# What it learns stays in build/fuzz/corpus/NAME, input that fails in build/fuzz/found/.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=${PHAROS_BUILD:-$root/build/fuzz}
name=${1:?usage: fuzz.sh checkpoint|config|image|mesh|mitsuba|model|pbrt [seconds] [libFuzzer options]}
seconds=${2:-600}
shift $(($# < 2 ? $# : 2))

corpus=$build/corpus/$name
mkdir -p "$corpus" "$build/found"
words=$build/corpus/$name.dict
export ASAN_OPTIONS=${ASAN_OPTIONS:-detect_leaks=0:allocator_may_return_null=0}

memory=1024  # of one allocation [MiB]
case $name in
  config)
    # Configs with every value in force, their scenes in place, and the scenes by themselves.
    for config in "$root"/configs/*.yaml; do
      seed=$corpus/$(basename "$config")
      "$build/pharos" validate "$config" >"$seed" 2>/dev/null || cp "$config" "$seed"
    done
    for scene in "$root"/scenes/*/scene.yaml; do
      { echo 'budget: { spp: 1 }' && echo 'scene:' && sed 's/^/  /' "$scene"; } \
        >"$corpus/$(basename "$(dirname "$scene")").yaml"
    done
    "$build/pharos" plugins --markdown | grep -o '`[a-z0-9_]\+`' | sort -u | tr '`' '"' >"$words"
    limit=16384 ;;
  mesh)
    # One triangle in each format; the first byte is the format's number.
    printf '\0ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >"$corpus/ascii.ply"
    printf '\0ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200?\0\0\0\0\0\0\0\0\0\0\0\0\0\0\200?\0\0\0\0\3\0\0\0\0\1\0\0\0\2\0\0\0' >"$corpus/binary.ply"
    printf '\1v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nf 1/1/1 2/1/1 3/1/1\n' >"$corpus/triangle.obj"
    printf '\2solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n' >"$corpus/ascii.stl"
    printf '\3{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:application_octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}' >"$corpus/triangle.gltf"
    # In zlib's form, yet not packed; the checksum counts after everything else has been read.
    printf '\005\034\004\004\000\170\001\001\106\000\271\377\000\020\000\000\164\000\003\000\000\000\000\000\000\000\001\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000\000\000\000\000\000\000\000\000\000\000\200\077\000\000\000\000\000\000\000\000\001\000\000\000\002\000\000\000\111\324\002\012\000\000\000\000\000\000\000\000\001\000\000\000' >"$corpus/triangle.serialized"
    printf '"%s"\n' vertex face element property list uchar int float double format end_header \
      binary_little_endian binary_big_endian vertex_indices mtllib usemtl solid facet endloop \
      accessors bufferView byteOffset byteStride componentType indices sparse count >"$words"
    limit=4096 ;;
  mitsuba)
    # A scene in each dialect; include files of the fuzzer's own.
    printf '<scene version="0.6.0"><default name="n" value="1"/><integrator type="path"><integer name="maxDepth" value="$n"/></integrator><sensor type="perspective"><transform name="toWorld"><scale value="2"/><rotate y="1" angle="30"/><lookAt origin="0,0,1" target="0 0 0" up="0 1 0"/><matrix value="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"/></transform><film type="hdrfilm"/></sensor><bsdf type="diffuse" id="a"><srgb name="reflectance" value="#ff8000"/></bsdf><alias id="a" as="b"/><shape type="sphere"><point name="center" x="0" y="1" z="2"/><ref id="b"/><emitter type="area"><blackbody name="radiance" temperature="5000K" scale="2"/></emitter></shape></scene>' >"$corpus/old.xml"
    printf '<?xml version="1.0"?>\n<!-- c -->\n<scene version="3.0.0"><path value="."/><include filename="a.xml"/><include filename="b.xml"/><bsdf type="conductor"><spectrum name="eta" value="400:0.1, 500:0.2, 700:1"/><spectrum name="k" filename="s.spd"/></bsdf><shape type="cube"><transform name="to_world"><translate value="1 2 3"/></transform><boolean name="flip_normals" value="true"/><string name="filename" value="m.ply"/><ref name="bsdf" id="inc"/></shape></scene>' >"$corpus/new.xml"
    grep -o '"[A-Za-z]*"' "$root/plugins/importers/mitsuba/document/names.h" >"$words"
    printf '"%s"\n' name value type id as filename version temperature origin target up angle \
      '<!--' '-->' '<![CDATA[' ']]>' '<?xml' '&quot;' '<scene version=\"0.6.0\">' '</scene>' >>"$words"
    limit=4096 ;;
  pbrt)
    printf 'LookAt 0 1 4  0 1 0  0 1 0\nCamera "perspective" "float fov" 40\nFilm "rgb" "integer xresolution" [ 8 ]\nWorldBegin # world\nTexture "t" "spectrum" "checkerboard" "float uscale" 8 "rgb tex1" [ .1 .2 .3 ]\nAttributeBegin\nAreaLightSource "diffuse" "blackbody L" 4000\nRotate 90 1 0 0\nMaterial "coateddiffuse" "texture reflectance" "t" "float roughness" .1\nShape "trianglemesh" "point3 P" [ 0 0 0 1 0 0 0 1 0 ] "integer indices" [ 0 1 2 ]\nAttributeEnd\nInclude "a.pbrt"\nShape "sphere"\n' >"$corpus/room.pbrt"
    printf 'MakeNamedMedium "fog" "rgb sigma_s" [ 1 1 1 ]\nMediumInterface "" "fog"\nCamera "orthographic"\nWorldBegin\nMakeNamedMaterial "m" "string type" "conductor" "spectrum eta" "metal-Cu-eta" "spectrum k" [ 400 1 700 2 ]\nNamedMaterial "m"\nObjectBegin "o"\nTransform [ 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 ]\nShape "disk" "float alpha" .5\nObjectEnd\nObjectInstance "o"\nLightSource "spot" "float power" 10\nLightSource "infinite" "spectrum L" "s.spd"\n' >"$corpus/fog.pbrt"
    grep -oh '"[A-Za-z0-9.-]*"' "$root"/plugins/importers/pbrt/*.cpp "$root"/plugins/pbrt_syntax/*.cpp | sort -u | grep -v '""' >"$words"
    limit=4096 ;;
  checkpoint | image | model)
    # Files that a small render leaves, each after the byte that says what it is.
    left=$(mktemp -d)
    trap 'rm -rf "$left"' EXIT
    (cd "$left" && "$build/pharos" render "$root/configs/cornell-box.yaml" -q -o a.exr \
      --set 'film={ width: 4, height: 4 }' --set budget.spp=8 --set output.checkpoint=a.checkpoint \
      --set 'integrator={ type: path, guiding: pavmm }')
    if [ "$name" = checkpoint ]; then
      { printf '\0' && cat "$left/a.checkpoint"; } >"$corpus/file"
      printf '\1pharos render 1\n' >"$corpus/state"
    elif [ "$name" = image ]; then
      { printf '\0' && cat "$left/a.exr"; } >"$corpus/a.exr"
      { printf '\3' && cat "$left/a.png"; } >"$corpus/a.png"
      printf '\4P6 2 2 255\n123456789012' >"$corpus/a.ppm"
      memory=6144  # the largest images that Pharos reads take 4 GiB
    else
      for learner in 0 1 2 3 4 5 6 7; do
        { printf "\\$learner" && head -c 512 /dev/zero; } >"$corpus/$learner"
      done
    fi
    rm -rf "$left"
    printf '"%s"\n' pharos render film guiding pharoscp pharosgm IHDR IDAT IEND channels \
      dataWindow compression >"$words"
    limit=65536 ;;
  *)
    echo "fuzz.sh: there is no fuzzer '$name'" >&2
    exit 2 ;;
esac
exec "$build/fuzz-$name" "$corpus" -dict="$words" -max_total_time="$seconds" -max_len="$limit" \
  -timeout=20 -rss_limit_mb=$((2 * memory)) -malloc_limit_mb=$memory -artifact_prefix="$build/found/$name-" "$@"
