#include "surehit_query/query_program.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "command_line/program.hpp"
#include "surehit_query/answer_queries.hpp"
#include "surehit_query/baked_collider.hpp"
#include "surehit_query/explain_query.hpp"

namespace surehit::example {
namespace {

template <typename Choice>
using Choices = std::vector<std::pair<std::string, Choice>>;

/// The first of the choices is the default.
template <typename Choice>
void add_choice(CLI::App& command, const std::string& name, Choice& choice, const Choices<Choice>& choices,
                const std::string& description) {
  std::vector<std::string> names;
  for (const auto& entry : choices) names.push_back(entry.first);
  const auto choose = [&choice, choices, names](const std::string& chosen) {
    const auto index = std::find(names.begin(), names.end(), chosen) - names.begin();
    choice = choices[static_cast<std::size_t>(index)].second;
  };
  command.add_option_function<std::string>(name, choose, description)
      ->check(CLI::IsMember(names).description(""))
      ->type_name(CLI::detail::join(names, "|"))
      ->default_str(names.front());
}

/// A scene takes the place of the mesh. Then `check` looks at MESH and FILE.
void add_scene(CLI::App& command, QueryRequest& request, CLI::Option& mesh, CLI::Option& file) {
  const auto choose = [&](const std::string& path) {
    request.scene_path = path;
    mesh.required(false);
    file.required(false);
  };
  command
      .add_option_function<std::string>("--scene", choose,
                                        "Ask the meshes that this file places, instead of MESH; - is standard input")
      ->type_name("SCENE");
}

void add_scalar(CLI::App& command, QueryRequest& request, const std::string& description) {
  add_choice<ScalarKind>(command, "--scalar", request.scalar,
                         {{"float", ScalarKind::single_precision}, {"double", ScalarKind::double_precision}},
                         description);
}

/// What numbers are, and where the answers go.
void add_form(CLI::App& command, QueryRequest& request, bool takes_shapes) {
  add_scalar(command, request, "The type that all numbers are read to and answers rounded to");
  Choices<PathForm> forms = {{"segment", PathForm::segment}, {"ray", PathForm::ray}, {"line", PathForm::line}};
  std::string description = "What a path is: from p to q, from p along a direction, or both ways along it";
  if (takes_shapes) {
    forms.insert(forms.end(), {{"sphere", PathForm::sphere}, {"box", PathForm::box}, {"capsule", PathForm::capsule}});
    description += "; or a shape whose centre moves from p to q";
  }
  add_choice<PathForm>(command, "--path", request.path, forms, description);
  command.add_option("-o", request.output_path, "Where the answers go; - is standard output")
      ->type_name("OUT")
      ->capture_default_str();
}

CLI::App& add_command(CLI::App& app, QueryRequest& request, Question question, const std::string& name,
                      const std::string& description) {
  CLI::App& command = *app.add_subcommand(name, description);
  command.callback([&request, question] { request.question = question; });
  CLI::Option* mesh = nullptr;
  if (question != Question::pair) {
    mesh = command.add_option("MESH", request.mesh_path,
                              "A mesh: .obj, .ply, .stl or .off, or what bake wrote; none with --scene");
    mesh->required()->type_name("");
  }
  CLI::Option* const file =
      command.add_option("FILE", request.input_path, "The paths, one a line; - is standard input");
  file->required()->type_name("");
  if (mesh != nullptr) add_scene(command, request, *mesh, *file);
  add_form(command, request, true);
  command
      .add_option("--threads", request.threads, "Threads that share the paths; the output is the same for any number")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1024}).description(""))
      ->capture_default_str();
  return command;
}

/// What narrows any query.
void add_limits(CLI::App& command, QueryRequest& request) {
  command.add_option("--min-t", request.min_t, "Cut paths to t of this or more, compared exactly")
      ->type_name("T")
      ->capture_default_str();
  command.add_option("--max-t", request.max_t, "Cut paths to t of this or less, compared exactly")
      ->type_name("T")
      ->capture_default_str();
  add_choice<Culling>(command, "--cull", request.culling,
                      {{"none", Culling::none}, {"back", Culling::back}, {"front", Culling::front}},
                      "Leave out the hits on this side of a triangle; back and front also leave out those in its "
                      "plane, which are edge_on");
  command.add_flag("--ignore-start-contact", request.ignore_start_contact,
                   "Leave out the triangles that hold the path's start, or that a shape touches there");
  command.add_flag("--ignore-end-contact", request.ignore_end_contact,
                   "Leave out the triangles that hold the end of the segment");
}

/// What leaves out triangles of a mesh.
void add_triangle_filters(CLI::App& command, QueryRequest& request) {
  command
      .add_option("--masks", request.masks_path,
                  "A file with a mask a line, for each triangle or for each face; without it all bits are set")
      ->type_name("FILE");
  command
      .add_option("--mask", request.mask,
                  "Ask only the triangles, or in a scene the instances, whose mask shares a bit with this one")
      ->type_name("BITS")
      ->default_str("0xffffffff");
  command
      .add_option("--ignore-triangle", request.ignored_triangle,
                  "Leave out this triangle; in a scene, leave out nothing else of the ignored instance")
      ->type_name("ID");
  command.add_option("--ignore-face", request.ignored_face, "Leave out all triangles of this face")->type_name("ID");
}

/// What leaves out parts of a mesh or of a scene.
void add_mesh_filters(CLI::App& command, QueryRequest& request) {
  add_triangle_filters(command, request);
  command.add_option("--ignore-instance", request.ignored_instance, "Leave out this instance of the scene")
      ->type_name("ID");
  command.add_flag("--statistics", request.wants_statistics,
                   "Then say on standard error, as CSV, what the queries did: cells walked, candidate triangles, how "
                   "many of them the filter left undecided, and how often it took exact arithmetic");
}

void add_ids(CLI::App& command, QueryRequest& request) {
  add_choice<IdKind>(command, "--ids", request.ids, {{"triangle", IdKind::triangle}, {"face", IdKind::face}},
                     "What ids in the output are of: the triangles, or the file's faces that they were cut from");
}

void add_more_columns(CLI::App& command, QueryRequest& request) {
  command.add_flag("--points", request.wants_points, "More columns x,y,z: the point of the path at the rounded t");
  command.add_flag("--normals", request.wants_normals, "More columns nx,ny,nz: the unit normal of the triangle");
}

/// Where a mesh of floats is asked about straight paths.
void add_gpu(CLI::App& command, QueryRequest& request) {
  command.add_flag("--gpu", request.uses_gpu, "Ask on a GPU, for straight paths in float; same output");
  const auto choose = [&request](const std::string& name) {
    request.uses_gpu = true;
    request.gpu_name = name;
  };
  command
      .add_option_function<std::string>("--gpu-name", choose,
                                        "Ask on the GPU with this in its name, which may be software")
      ->type_name("NAME");
}

constexpr const char* path_of_a_mesh = "FILE: 6 numbers a line: p, then q or the direction.\n";

constexpr const char* paths_of_a_mesh =
    "FILE: 6 numbers a line: p, then q or the direction. Shapes have more: a sphere its radius, a box its three\n"
    "half extents, and a capsule the three numbers of its half axis and its radius.\n";

constexpr const char* shape_columns_help =
    "Shapes have feature,started_touching in place of side: what is touched, face, edge_ab, edge_bc, edge_ca,\n"
    "corner_a, corner_b or corner_c, and 1 if they touch at t = 0 already.\n";

constexpr const char* scenes =
    "SCENE: a text file with one instance a line: a mesh file, the 12 numbers of its pose, and if need be\n"
    "motion X Y Z and mask BITS. The pose is m00 m01 m02 m0  m10 m11 m12 m1  m20 m21 m22 m2: a corner v of the\n"
    "mesh is exactly at M v + m. At t of a segment or of a shape, the instance has moved by t (X, Y, Z). Mesh files\n"
    "are relative to the scene file. Shapes have the sizes and axes of the scene. Names with white space or commas "
    "stand in \"quotation marks\". In the output, the\n"
    "column instance is before that of ids. It counts the lines that place a mesh, from 0. A miss has -1 in both.\n"
    "Of equal exact t, the least instance comes first, and then the least triangle.\n";

constexpr const char* meshes =
    "MESH: OBJ, PLY, STL or OFF, told apart by the ending of its name; PLY and STL may be binary. A file that bake\n"
    "wrote is known by its first bytes. It has no faces, and the type of its numbers is fixed. Lines end in\n"
    "\\n, \\r\\n or \\r. Colors, normals and texture coordinates are passed over. Refused, with the line or the\n"
    "element: words that are no numbers, indices out of range, faces of less than 3 corners, coordinates that\n"
    "are not finite where a face uses them, and whatever else is not wholly understood.\n"
    "Polygons are cut into triangles by exact decisions: convex ones as fans of their first corner, others by\n"
    "cutting ears off; one whose outline crosses itself is refused. Ids count from 0 in the order of the file.\n"
    "Warnings are lines on standard error: no triangles, no instances, float too coarse for the file, unused\n"
    "vertices that are not finite. examples/mesh_io/README.md has a table of formats and dialects.";

void add_explain(CLI::App& app, QueryRequest& request) {
  CLI::App& command = *app.add_subcommand("explain", "How does a path come to what it first meets?");
  command.callback([&request] { request.question = Question::explain; });
  command.add_option("MESH", request.mesh_path, "A mesh: .obj, .ply, .stl or .off, or what bake wrote")
      ->required()
      ->type_name("");
  command.add_option("FILE", request.input_path, "The path; - is standard input")->required()->type_name("");
  command.add_option("--index", request.index, "Which path, if FILE has several; they count from 0")->type_name("I");
  command
      .add_option("--draw", request.drawings,
                  "Draw the cells, the candidates and the path to this file: .ply, .obj or .png; may be given again")
      ->type_name("FILE")
      ->allow_extra_args(false);
  add_form(command, request, false);
  add_limits(command, request);
  add_triangle_filters(command, request);
  command.footer(
      std::string(path_of_a_mesh) +
      "Output: the way of a query for the first hit, for people to read. The cells that the path walks through, each\n"
      "with its t and its box; the triangles that their lists ask, with the five determinants of Möller and Trumbore\n"
      "as the filter has them, and their error bounds; the stage that decides each; the order of the hits; how t, u\n"
      "and v are rounded; the answer, which is that of the command first. Drawings have the path in yellow,\n"
      "empty cells in blue, passed cells in violet, cells whose list is asked in green, misses in grey, hits in "
      "orange,\n"
      "and the first hit in red.\n" +
      meshes);
}

void add_bake(CLI::App& app, QueryRequest& request) {
  CLI::App& command = *app.add_subcommand("bake", "Save a mesh with its grid, to be asked at once");
  command.callback([&request] { request.question = Question::bake; });
  command.add_option("MESH", request.mesh_path, "A mesh: .obj, .ply, .stl or .off")->required()->type_name("");
  command.add_option("-o", request.output_path, "Where the bytes go; - is standard output")
      ->required()
      ->type_name("OUT");
  add_scalar(command, request, "The type that all numbers are read to; the file can be asked in no other");
  command
      .add_option("--masks", request.masks_path,
                  "A file with a mask a line, for each triangle or for each face; without it all bits are set")
      ->type_name("FILE");
  command.footer(std::string("OUT takes the place of MESH in all other commands. The bytes are the same on every "
                             "machine.\ncollision/FORMAT.md describes them.\n") +
                 meshes);
}

void describe(CLI::App& app, QueryRequest& request) {
  request.threads = std::clamp(std::thread::hardware_concurrency(), 1u, 1024u);
  app.require_subcommand(1);
  app.get_formatter()->column_width(36);
  app.footer(
      "A line of FILE holds the numbers of one path: p, then q or the direction, then a shape's size. They are decimal "
      "or hex\n"
      "floats (0x1.8p-3), with white space, a comma or both between them. Blank lines and lines that begin\n"
      "with # are skipped. Answers are exact, their numbers rounded once to nearest; what is written reads\n"
      "back to the same bits. COMMAND --help tells the options and the output of a command.\n"
      "Exit status: 0, 2 for bad input or usage, 1 for any other failure.");

  CLI::App& pair = add_command(app, request, Question::pair, "pair", "Does each path meet the triangle beside it?");
  add_limits(pair, request);
  add_more_columns(pair, request);
  pair.footer(
      "FILE: 15 numbers a line: p, then q or the direction, then the corners a, b and c. A shape has its size before\n"
      "the corners: a sphere its radius, a box its three half extents, and a capsule the three numbers of its half\n"
      "axis and its radius.\n"
      "Output: hit,t,u,v,side, one line a pair; a miss is 0,,,, and side is front, back or edge_on. Of shapes:\n"
      "hit,t,u,v,feature,started_touching, and a miss is 0,,,,, .");

  CLI::App& first = add_command(app, request, Question::first, "first", "Where does each path first meet the mesh?");
  add_limits(first, request);
  add_mesh_filters(first, request);
  add_ids(first, request);
  add_more_columns(first, request);
  first.add_flag("--free-points", request.wants_free_points,
                 "More columns free_x,free_y,free_z: where a point that moves along the segment may stop so that it "
                 "has touched nothing");
  add_gpu(first, request);
  first.footer(std::string(paths_of_a_mesh) +
               "Output: triangle,t,u,v,side, one line a path; a miss is -1,,,,. Of equal exact t the least triangle "
               "wins.\n" +
               shape_columns_help + scenes + meshes);

  CLI::App& any = add_command(app, request, Question::any, "any", "Does each path meet the mesh at all?");
  add_limits(any, request);
  add_mesh_filters(any, request);
  add_gpu(any, request);
  any.footer(std::string(paths_of_a_mesh) + "Output: hit, one line a path: 1 or 0.\n" + scenes + meshes);

  CLI::App& all =
      add_command(app, request, Question::all, "all", "Where does each path meet the mesh, every triangle?");
  add_limits(all, request);
  add_mesh_filters(all, request);
  add_ids(all, request);
  add_more_columns(all, request);
  all.footer(std::string(paths_of_a_mesh) +
             "Output: path,triangle,t,u,v,side,tie, one line a hit, in order along the path; paths count from 0. tie "
             "is 1\nwhere another hit of the path has the very same exact t, else 0. Shapes have no column tie.\n" +
             shape_columns_help + scenes + meshes);

  add_explain(app, request);
  add_bake(app, request);
}

/// Whatever else is said of a scene fits it. A single name beside it is that of the paths.
void check_scene(QueryRequest& request) {
  if (request.scene_path.empty()) {
    if (request.ignored_instance) throw CLI::ValidationError("--ignore-instance", "only a scene has instances");
    return;
  }
  if (!request.input_path.empty()) throw CLI::ValidationError("--scene", "there is a MESH beside it");
  if (request.mesh_path.empty()) throw CLI::RequiredError("FILE");
  request.input_path = std::exchange(request.mesh_path, {});
  if (!request.masks_path.empty()) throw CLI::ValidationError("--masks", "a scene takes none");
  if (request.ignored_face) throw CLI::ValidationError("--ignore-face", "a scene takes none");
  if (request.ignored_triangle && !request.ignored_instance) {
    throw CLI::ValidationError("--ignore-triangle", "a scene takes it with --ignore-instance alone");
  }
  if (request.scene_path == "-" && request.input_path == "-") {
    throw CLI::ValidationError("--scene", "standard input cannot be FILE too");
  }
}

/// Each drawing is of a kind that its name tells.
void check_drawings(const QueryRequest& request) {
  for (const std::string& file : request.drawings) {
    if (!file.ends_with(".ply") && !file.ends_with(".obj") && !file.ends_with(".png")) {
      throw CLI::ValidationError("--draw", file + " ends in none of .ply, .obj and .png");
    }
  }
}

/// What only straight paths have.
void check_shape(const QueryRequest& request) {
  const auto refuse = [](bool is_given, const char* option) {
    if (is_given) throw CLI::ValidationError(option, "only straight paths have it");
  };
  refuse(request.min_t != "-inf", "--min-t");
  refuse(request.ignore_end_contact, "--ignore-end-contact");
  refuse(request.wants_points, "--points");
  refuse(request.wants_normals, "--normals");
}

/// What a GPU can be asked.
void check_gpu(const QueryRequest& request) {
  if (!request.uses_gpu) return;
  if (is_shape(request.path)) throw CLI::ValidationError("--gpu", "only straight paths have it");
  if (request.scalar != ScalarKind::single_precision) throw CLI::ValidationError("--gpu", "only float has it");
}

/// What no single option can know.
void check(QueryRequest& request) {
  if (is_shape(request.path)) check_shape(request);
  check_scene(request);
  check_gpu(request);
  check_drawings(request);
  if (request.wants_free_points && request.path != PathForm::segment) {
    throw CLI::ValidationError("--free-points", "only a segment has them");
  }
  if (request.masks_path == "-" && request.input_path == "-") {
    throw CLI::ValidationError("--masks", "standard input cannot be FILE too");
  }
}

Work describe_program(CLI::App& app) {
  const auto request = std::make_shared<QueryRequest>();
  describe(app, *request);
  return [request] {
    check(*request);
    if (request->question == Question::explain) {
      explain_query(*request);
    } else if (request->question == Question::bake) {
      bake(*request);
    } else {
      answer_queries(*request);
    }
    return success;
  };
}

}  // namespace

int run_query_program(int argc, char** argv) noexcept {
  return run_program("surehit-query", "Asks exactly where straight paths and moving shapes meet triangles.", argc, argv,
                     describe_program);
}

}  // namespace surehit::example
