#include <gtest/gtest.h>

#include <string>

#include "surehit_query_run.hpp"

namespace surehit::test::surehit_query_options_test {
namespace {

/// What narrows a query, and what it is asked for besides.
class SurehitQueryOptions : public SurehitQueryRun {};

TEST_F(SurehitQueryOptions, cuts_paths_to_a_range_of_t) {
  write_squares();
  write("paths", "0.5 0.25 3  0.5 0.25 -1\n");
  const std::string header = "triangle,t,u,v,side\n";
  const std::string upper = header + "2,0.5,0.25,0.25,front\n";
  const std::string lower = header + "0,0.75,0.25,0.25,front\n";
  const std::string miss = header + "-1,,,,\n";
  expect_output("first squares.obj paths --min-t 0.5", upper);
  expect_output("first squares.obj paths --min-t 0.50001", lower);
  expect_output("first squares.obj paths --min-t 0x1.8p-1 --max-t 1", lower);
  expect_output("first squares.obj paths --max-t=0.49", miss);
  expect_output("first squares.obj paths --min-t -inf --max-t inf", upper);
  expect_output("first squares.obj paths --path line --min-t -1e38 --max-t -1", miss);
  expect_output("any squares.obj paths --min-t 0.8", "hit\n0\n");
  expect_output("all squares.obj paths --min-t 0.6", "path,triangle,t,u,v,side,tie\n0,0,0.75,0.25,0.25,front,0\n");
  write("pairs", downwards + triangle + "\n");
  expect_output("pair pairs --max-t 0.25", "hit,t,u,v,side\n0,,,,\n");

  // A limit is rounded once, to the type that is asked for.
  write("third", "0.5 0.25 2  0.5 0.25 -1\n");
  expect_output("first squares.obj third --max-t 0.33333333333333 --ignore-triangle 0",
                header + "2,0.33333334,0.25,0.25,front\n");
  expect_output("first squares.obj third --max-t 0.33333333333333 --ignore-triangle 0 --scalar double", miss);

  expect_bad_input("first squares.obj paths --min-t nan", "--min-t: 'nan' is not a number");
  expect_bad_input("first squares.obj paths --max-t 1,5", "--max-t: '1,5' is not a number");
  expect_bad_input("first squares.obj paths --max-t 1e39", "--max-t: '1e39' is beyond the largest float");
}

TEST_F(SurehitQueryOptions, ignores_contacts_at_the_ends_of_paths) {
  write_squares();
  write("paths", "0.5 0.25 1  0.5 0.25 0\n");
  expect_output("first squares.obj paths", "triangle,t,u,v,side\n2,0,0.25,0.25,front\n");
  expect_output("first squares.obj paths --ignore-start-contact", "triangle,t,u,v,side\n0,1,0.25,0.25,front\n");
  expect_output("any squares.obj paths --ignore-start-contact --ignore-end-contact", "hit\n0\n");
  expect_output("all squares.obj paths --ignore-end-contact",
                "path,triangle,t,u,v,side,tie\n0,2,0,0.25,0.25,front,0\n");
  write("pairs", "0 0 1  0 0 0  " + triangle + "\n");
  expect_output("pair pairs --ignore-end-contact", "hit,t,u,v,side\n0,,,,\n");
}

TEST_F(SurehitQueryOptions, ignores_a_triangle_or_a_face) {
  write_squares();
  write("paths", "0.5 0.5 3  0.5 0.5 -1\n");
  const std::string header = "triangle,t,u,v,side\n";
  expect_output("first squares.obj paths", header + "2,0.5,0,0.5,front\n");
  expect_output("first squares.obj paths --ignore-triangle 2", header + "3,0.5,0.5,0,front\n");
  expect_output("first squares.obj paths --ignore-face 1", header + "0,0.75,0,0.5,front\n");
  expect_output("any squares.obj paths --ignore-face 1 --max-t 0.7", "hit\n0\n");
  expect_bad_input("first squares.obj paths --ignore-triangle 4",
                   "--ignore-triangle: there is no triangle 4 among 4, which count from 0");
  expect_bad_input("first squares.obj paths --ignore-face 2",
                   "--ignore-face: there is no face 2 among 2, which count from 0");
}

TEST_F(SurehitQueryOptions, takes_masks_of_triangles_or_of_faces) {
  write_squares();
  write("paths", "0.5 0.5 3  0.5 0.5 -1\n");
  write("by_triangle", "# masks\n0x1\n1\n\n 2 \n4294967295\r\n");
  write("by_face", "1\n0XfE\n");
  const std::string header = "triangle,t,u,v,side\n";
  const std::string upper = header + "2,0.5,0,0.5,front\n";
  const std::string lower = header + "0,0.75,0,0.5,front\n";
  expect_output("first squares.obj paths --masks by_triangle", upper);
  expect_output("first squares.obj paths --masks by_triangle --mask 1", header + "3,0.5,0.5,0,front\n");
  expect_output("first squares.obj paths --masks by_triangle --mask 2", upper);
  expect_output("first squares.obj paths --masks by_face --mask 1", lower);
  expect_output("first squares.obj paths --masks by_face --mask 0x80", upper);
  expect_output("any squares.obj paths --masks by_face --mask 0x100", "hit\n0\n");
  expect_output("any squares.obj paths --mask 0", "hit\n0\n");
  expect_output("first squares.obj paths --masks by_triangle --ignore-face 1", lower);
  expect_output("first squares.obj paths --masks - <by_face --mask 1", lower);

  write("bad", "1\n2\n");
  write("squares_and_more.obj", folder_.read("squares.obj") + "f 1 2 3\n");
  expect_bad_input("first squares_and_more.obj paths --masks bad", "bad: 2 masks for 5 triangles of 3 faces");
  for (const char* mask : {"-1", "4294967296", "x", "0x", "1.5", "0x-1"}) {
    write("bad", "1\n" + std::string(mask) + "\n");
    expect_bad_input("first squares.obj paths --masks bad",
                     "bad: line 2: '" + std::string(mask) + "' is no mask of 32 bits");
  }
  write("bad", "1 2\n");
  expect_bad_input("first squares.obj paths --masks bad", "bad: line 1: expected one mask, not 2");
  expect_bad_input("first squares.obj paths --masks none", "none: cannot be read: No such file or directory");
}

TEST_F(SurehitQueryOptions, names_the_faces_that_triangles_were_cut_from) {
  write_squares();
  write("paths", "0.5 0.25 3  0.5 0.25 -1\n0.25 0.5 3  0.25 0.5 0.5\n9 9 9  8 8 8\n");
  expect_output("first squares.obj paths --ids triangle",
                "triangle,t,u,v,side\n2,0.5,0.25,0.25,front\n3,0.8,0.25,0.25,front\n-1,,,,\n");
  expect_output("first squares.obj paths --ids face",
                "face,t,u,v,side\n1,0.5,0.25,0.25,front\n1,0.8,0.25,0.25,front\n-1,,,,\n");
  expect_output("all squares.obj paths --ids face",
                "path,face,t,u,v,side,tie\n0,1,0.5,0.25,0.25,front,0\n0,0,0.75,0.25,0.25,front,0\n"
                "1,1,0.8,0.25,0.25,front,0\n");
  write("triangles.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\n");
  expect_output("all triangles.obj - --ids face <<END\n0.25 0.25 1 0.25 0.25 -1\nEND\n",
                "path,face,t,u,v,side,tie\n0,0,0.5,0.25,0.25,front,1\n0,1,0.5,0.25,0.25,front,1\n");
}

TEST_F(SurehitQueryOptions, tells_points_and_normals) {
  write("tilted.obj", "v 0 0 0\nv 4 0 3\nv 0 4 0\nf 1 2 3\n");
  write("paths", "1 1 8  1 1 0\n9 9 9  8 8 8\n");
  const std::string hit = "0,0.90625,0.25,0.25,front";
  const std::string point = ",1,1,0.75";
  const std::string normal = ",-0.6,0,0.8";
  const std::string header = "triangle,t,u,v,side";
  expect_output("first tilted.obj paths --points", header + ",x,y,z\n" + hit + point + "\n-1,,,,,,,\n");
  expect_output("first tilted.obj paths --normals", header + ",nx,ny,nz\n" + hit + normal + "\n-1,,,,,,,\n");
  expect_output("first tilted.obj paths --normals --points",
                header + ",x,y,z,nx,ny,nz\n" + hit + point + normal + "\n-1,,,,,,,,,,\n");
  expect_output("all tilted.obj paths --points --normals",
                "path," + header + ",tie,x,y,z,nx,ny,nz\n0," + hit + ",0" + point + normal + "\n");
  write("pairs", "1 1 8  0 0 -1  0 0 0  4 0 3  0 4 0\n1 1 8  0 0 1  0 0 0  4 0 3  0 4 0\n");
  expect_output("pair pairs --path ray --points --normals",
                "hit,t,u,v,side,x,y,z,nx,ny,nz\n1,7.25,0.25,0.25,front" + point + normal + "\n0,,,,,,,,,,\n");
}

TEST_F(SurehitQueryOptions, tells_where_a_step_may_end) {
  write_squares();
  write("paths", "0.5 0.25 2  0.5 0.25 -1\n9 9 9  8 8 8\n0.5 0.25 1  0.5 0.25 -1\n");
  expect_output("first squares.obj paths --free-points",
                "triangle,t,u,v,side,free_x,free_y,free_z\n2,0.33333334,0.25,0.25,front,0.5,0.25,1.0000001\n"
                "-1,,,,,8,8,8\n2,0,0.25,0.25,front,0.5,0.25,1\n");
  expect_output(
      "first squares.obj paths --free-points --points --ignore-start-contact <paths",
      "triangle,t,u,v,side,x,y,z,free_x,free_y,free_z\n2,0.33333334,0.25,0.25,front,0.5,0.25,1,0.5,0.25,1.0000001\n"
      "-1,,,,,,,,8,8,8\n0,0.5,0.25,0.25,front,0.5,0.25,0,0.5,0.25,1.1920929e-07\n");
}

TEST_F(SurehitQueryOptions, tells_ties_by_the_exact_t) {
  // Both planes are met at t = 1/3 as floats have it, but the second one exactly is 2^-30 higher: met first.
  write("near.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0x1p-30\nv 1 0 0x1p-30\nv 0 1 0x1p-30\nv 1 1 0\nf 1 2 3\nf 4 5 6\nf 2 7 3\n");
  write("paths", "0.25 0.25 1  0.25 0.25 -2\n0.5 0.5 1  0.5 0.5 -2\n");
  const std::string header = "path,triangle,t,u,v,side,tie\n";
  expect_output("all near.obj paths",
                header +
                    "0,1,0.33333334,0.25,0.25,front,0\n0,0,0.33333334,0.25,0.25,front,0\n"
                    "1,1,0.33333334,0.5,0.5,front,0\n1,0,0.33333334,0.5,0.5,front,1\n1,2,0.33333334,0,0.5,front,1\n");
  // Triangles in the path's plane are met where the path enters them, or is cut within them: there they tie.
  write("edge_on.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nf 1 2 3\nf 1 2 4\nf 2 5 4\n");
  write("in_plane", "0.5 0 2  0.5 0 -1\n");
  expect_output("all edge_on.obj in_plane",
                header + "0,2,0.33333334,0.5,0.5,edge_on,0\n0,1,0.5,0.5,0.5,edge_on,0\n0,0,0.6666667,0.5,0,front,0\n");
  expect_output("all edge_on.obj in_plane --min-t 0.5",
                header + "0,1,0.5,0.5,0.5,edge_on,1\n0,2,0.5,0,0.5,edge_on,1\n0,0,0.6666667,0.5,0,front,0\n");
}

}  // namespace
}  // namespace surehit::test::surehit_query_options_test
