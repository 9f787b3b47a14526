#include "surehit_query/explain_query.hpp"

#include <memory>
#include <string>
#include <surehit/explain.hpp>
#include <vector>

#include "command_line/output_file.hpp"
#include "mesh_io/input_error.hpp"
#include "picture/png.hpp"
#include "surehit_query/asked_mesh.hpp"
#include "surehit_query/explanation_drawing.hpp"
#include "surehit_query/explanation_picture.hpp"
#include "surehit_query/explanation_text.hpp"
#include "surehit_query/number_table.hpp"

namespace surehit::example {
namespace {

/// No shape is explained.
PathKind kind_of(PathForm form) {
  return form == PathForm::line ? PathKind::line : form == PathForm::ray ? PathKind::ray : PathKind::segment;
}

/// The path of the input that is meant.
template <typename Scalar>
Path<Scalar> read_path(const QueryRequest& request) {
  const auto table = read_number_table<Scalar>(request.input_path, 6);
  if (!request.index && table.rows() != 1) {
    throw InputError(request.input_path + ": there are " + std::to_string(table.rows()) +
                     " paths instead of one; --index tells which");
  }
  const std::size_t index = request.index.value_or(0);
  if (index >= table.rows()) {
    throw InputError("--index: there is no path " + std::to_string(index) + " among " + std::to_string(table.rows()) +
                     ", which count from 0");
  }
  const Scalar* const row = table.row(index);
  return {kind_of(request.path), {row[0], row[1], row[2]}, {row[3], row[4], row[5]}};
}

template <typename Scalar>
std::string drawing_text(const std::string& file, const Drawing& drawing, const Collider<Scalar>& mesh,
                         const Path<Scalar>& path) {
  if (file.ends_with(".ply")) return ply_text(drawing);
  if (file.ends_with(".obj")) return obj_text(drawing);
  const Vector3d toward = path.toward.template cast<double>();
  return encode_png(picture_of(drawing, mesh, path.has_end() ? toward - path.start.template cast<double>() : toward));
}

template <typename Scalar>
void explain_in(const QueryRequest& request) {
  const AskedMesh<Scalar> mesh(request);
  const Path<Scalar> path = read_path<Scalar>(request);
  const Explanation<Scalar> explanation = explain(mesh.target(), path, mesh.options());
  const Drawing drawing = draw_explanation(mesh.target(), path, explanation);

  // All files are written before any of them is there.
  std::vector<std::unique_ptr<OutputFile>> drawings;
  for (const std::string& file : request.drawings) {
    drawings.push_back(std::make_unique<OutputFile>(file));
    drawings.back()->write(drawing_text(file, drawing, mesh.target(), path));
  }
  OutputFile output(request.output_path);
  output.write(text_of(path, mesh.options(), explanation));
  output.finish();
  for (const auto& file : drawings) file->finish();
}

}  // namespace

void explain_query(const QueryRequest& request) {
  std::vector<NamedOutput> outputs = {{"-o", request.output_path}};
  for (const std::string& file : request.drawings) outputs.push_back({"--draw", file});
  refuse_equal_outputs(outputs);  // All of them are open at once.
  if (request.scalar == ScalarKind::single_precision) {
    explain_in<float>(request);
  } else {
    explain_in<double>(request);
  }
}

}  // namespace surehit::example
