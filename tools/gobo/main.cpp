// gobo, the compiler: what a build needs. What proves, draws and measures is gobo-lab's (tools/lab/commands).
#include "gobo/application.hpp"
#include "gobo/commands.hpp"

int main(int argc, char** argv) {
    using namespace gobo;
    return run_application(
        {"gobo",
         "composes lighting shaders from pieces, validates every permutation and emits a C++ header.",
         "  gobo list lit --all --where 'point <= 1' --count\n"
         "  gobo build lit --key 'fog=linear point=3' -o generated\n"
         "  gobo COMMAND --help",
         {repeatable(list_command()),
          repeatable(show_command()),
          repeatable(check_command()),
          repeatable(build_command()),
          repeatable(reflect_command()),
          repeatable(scene_command()),
          watch_command(),
          library_command(),
          cache_command(),
          merge_command(),
          {titles::kEval},
          {titles::kTest},
          {titles::kSanitize},
          {titles::kProve},
          {titles::kProbe},
          {titles::kRender},
          {titles::kLink},
          {titles::kCost},
          {titles::kStudy}}},
        argc, argv);
}
