// Copyright (c) 2026  The ARAP_deformation authors.
// All rights reserved.
//
// This file is part of CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later OR LicenseRef-Commercial
//
// Author(s)     : The ARAP_deformation authors

// What is the user's fails, at every call: solvers, weights, rotations, visitors, domains and
// property maps that throw or refuse. The mesh and the object are as they were.

#include "include/check.h"
#include "include/fault_stories.h"

#include <CGAL/ARAP_deformation/Multifrontal_cholesky_solver.h>
#include <CGAL/ARAP_deformation/Newton_closest_rotation.h>
#include <CGAL/ARAP_deformation/edge_weights.h>

#include <CGAL/tags.h>

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>

using CGAL::ARAP::Coordinates;
using CGAL::ARAP::Matrix_3x3;
using CGAL::ARAP::Sparse_matrix;
using CGAL::ARAP::Visitor_action;

Faults solver_faults, weight_faults, rotation_faults, visitor_faults, domain_faults, put_faults,
  point_faults;

void throw_if_hit(Faults& faults)
{
  if(faults.is_hit())
    throw Fault();
}

// whether a call throws where only the fault number `first` is injected
template <typename Function>
bool throws(Faults& faults, std::size_t first, const Function& call)
{
  bool has_thrown = false;
  faults.arm(first, false);
  try { call(); }
  catch(const Fault&) { has_thrown = true; }
  faults.disarm();
  return has_thrown;
}

enum class Failure { returns_false, throws_before, throws_after };
Failure failure_of_solver = Failure::returns_false;

// The copies that the class makes of a model may fail too.
struct Faulty_solver : CGAL::ARAP::Multifrontal_cholesky_solver
{
  using Base = CGAL::ARAP::Multifrontal_cholesky_solver;

  Faulty_solver() = default;
  Faulty_solver(Faulty_solver&&) = default;
  Faulty_solver& operator=(Faulty_solver&&) = default;

  Faulty_solver(const Faulty_solver& other) : Base(other) { throw_if_hit(solver_faults); }

  Faulty_solver& operator=(const Faulty_solver& other)
  {
    throw_if_hit(solver_faults);
    Base::operator=(other);
    return *this;
  }

  bool analyze(const Sparse_matrix& a)
  {
    return run_or_fail([&] { return Base::analyze(a); });
  }

  bool factorize(const Sparse_matrix& a)
  {
    return run_or_fail([&] { return Base::factorize(a); });
  }

  bool set_border(const Sparse_matrix& b, const Eigen::MatrixXd& d)
  {
    return run_or_fail([&] { return Base::set_border(b, d); });
  }

  bool solve(std::size_t n, Coordinates* x)
  {
    return run_or_fail([&] { return Base::solve(n, x); });
  }

private:
  template <typename Function>
  static bool run_or_fail(const Function& run)
  {
    if(!solver_faults.is_hit())
      return run();
    if(failure_of_solver == Failure::returns_false)
      return false;
    if(failure_of_solver == Failure::throws_after)
      run();
    throw Fault();
  }
};

struct Faulty_weight : CGAL::ARAP::Safe_cotangent_weight
{
  using Base = CGAL::ARAP::Safe_cotangent_weight;

  Faulty_weight() = default;
  Faulty_weight(const Faulty_weight& other) : Base(other) { throw_if_hit(weight_faults); }
  Faulty_weight& operator=(const Faulty_weight&) { throw_if_hit(weight_faults); return *this; }

  template <std::size_t N>
  auto simplex_weights(const std::array<Coordinates, N>& simplex) const
    -> decltype(Base().simplex_weights(simplex))
  {
    throw_if_hit(weight_faults);
    return Base::simplex_weights(simplex);
  }

  double edge_weight(CGAL::ARAP::Edge_set edge_set, std::size_t i, std::size_t j, double sum) const
  {
    throw_if_hit(weight_faults);
    return Base::edge_weight(edge_set, i, j, sum);
  }
};

struct Faulty_rotation : CGAL::ARAP::Newton_closest_rotation
{
  using Base = CGAL::ARAP::Newton_closest_rotation;

  Faulty_rotation() = default;
  Faulty_rotation(const Faulty_rotation& other) : Base(other) { throw_if_hit(rotation_faults); }
  Faulty_rotation& operator=(const Faulty_rotation&)
  {
    throw_if_hit(rotation_faults);
    return *this;
  }

  // throws when all is done
  void operator()(std::size_t n, const Matrix_3x3* covariances, Matrix_3x3* rotations) const
  {
    Base::operator()(n, covariances, rotations);
    throw_if_hit(rotation_faults);
  }
};

// One thread: faults are counted.
using Faulty_traits = CGAL::ARAP_deformation_traits<Faulty_solver, Faulty_weight, Faulty_rotation,
                                                      CGAL::Sequential_tag>;

void test_models()
{
  const auto test = [](Faults& faults, Fault_statistics& statistics, Cell_scheme cells) {
    test_stories(Fault_test<Session<Surface, Faulty_traits>>(faults, statistics), "surface", cells);
    test_stories(Fault_test<Session<Solid, Faulty_traits>>(faults, statistics), "solid",
                 cells.rings() > 0 ? Cell_scheme::k_ring(2) : cells);
  };
  Fault_statistics solver("solver"), weight("weights"), rotation("rotation");
  for(Cell_scheme cells : all_cell_schemes)
  {
    for(Failure f : {Failure::returns_false, Failure::throws_before, Failure::throws_after})
    {
      failure_of_solver = f;
      test(solver_faults, solver, cells);
    }
    test(weight_faults, weight, cells);
    test(rotation_faults, rotation, cells);
  }
}

// A visitor that throws or cancels at an iterate, after another one has been seen.
void test_visitors()
{
  using Session_ = Session<Solid, Faulty_traits>;
  using S = Steps<Session_>;
  using CGAL::ARAP::Initial_guess;
  using CGAL::ARAP::Minimizer;
  Fault_statistics statistics("visitor");
  for(bool throws : {false, true})
    for(Minimizer minimizer : {Minimizer::local_global, Minimizer::quasi_newton})
    {
      const Step<Session_> deform = {"deform", [throws](Session_& s) {
        return bool(s.deformation->deform([throws](const auto&) {
          const bool is_hit = visitor_faults.is_hit();
          if(is_hit && throws)
            throw Fault();
          return is_hit ? Visitor_action::cancel : Visitor_action::proceed;
        }));
      }};
      Fault_test<Session_> test(visitor_faults, statistics);
      test("visitor", [] { return std::make_unique<Session_>(); },
           {S::construct(), S::insert(),
            S::set_options(Cell_scheme::elements(), minimizer, Initial_guess::laplacian), deform,
            S::change_control_vertices(), deform, S::overwrite(), deform, S::reset(), deform});
    }
}

// A domain of which every function may throw; what writes points has its own faults.
struct Faulty_domain : Solid::Domain
{
  using Base = Solid::Domain;

  explicit Faulty_domain(const Base& base) : Base(base) {}

  static Coordinates coordinates(const Point& p) { return checked(Base::coordinates(p)); }
  static Point make_point(const Coordinates& c) { return checked(Base::make_point(c)); }
  std::size_t index(std::size_t v) const { return checked(Base::index(v)); }
  const Point& point(std::size_t v) const { return checked(Base::point(v)); }
  bool is_isolated(std::size_t v) const { return checked(Base::is_isolated(v)); }

  void set_point(std::size_t v, const Point& p) const
  {
    throw_if_hit(put_faults);
    Base::set_point(v, p);
  }

  template <typename Function>
  void for_each_incident_simplex(std::size_t v, const Function& f) const
  {
    Base::for_each_incident_simplex(v, [&](std::size_t s, const auto& corners) {
      f(checked(s), corners);
    });
  }

private:
  template <typename T>
  static T&& checked(T&& value)
  {
    throw_if_hit(domain_faults);
    return std::forward<T>(value);
  }
};

void test_domain()
{
  using Session_ = Session<Solid, CGAL::ARAP_deformation_traits<>, Faulty_domain>;
  Fault_statistics domain("domain"), put("writing points");
  for(Cell_scheme cells : {Cell_scheme::spokes(), Cell_scheme::elements()})
  {
    test_stories(Fault_test<Session_>(domain_faults, domain), "domain", cells);
    test_stories(Fault_test<Session_>(put_faults, put, false), "writing points", cells);
  }
  test_story_of_undo(Fault_test<Session_>(domain_faults, domain), "domain, undo");
  test_story_of_undo(Fault_test<Session_>(put_faults, put, false), "writing points, undo");
}

// A point whose copies may throw, and what is moved does not.
struct Faulty_point : Bare_point
{
  using Bare_point::Bare_point;

  Faulty_point(Faulty_point&&) noexcept = default;
  Faulty_point& operator=(Faulty_point&&) noexcept = default;

  Faulty_point(const Faulty_point& other) : Bare_point(other) { throw_if_hit(point_faults); }

  Faulty_point& operator=(const Faulty_point& other)
  {
    throw_if_hit(point_faults);
    Bare_point::operator=(other);
    return *this;
  }
};

// the same, but all of its moves are copies
struct Copied_point : Bare_point
{
  using Bare_point::Bare_point;

  Copied_point(const Copied_point& other) : Bare_point(other) { throw_if_hit(point_faults); }

  Copied_point& operator=(const Copied_point& other)
  {
    throw_if_hit(point_faults);
    Bare_point::operator=(other);
    return *this;
  }
};

template <typename Point_>
struct Solid_of
{
  using Points = std::vector<Point_>;
  using Base = CGAL::ARAP::Tetrahedron_soup_domain<Points, Solid::Tetrahedra>;

  // writes points without a fault, so that a failure has to leave them as they were
  struct Domain : Base
  {
    Points* written;

    Domain(Points& points, const Solid::Tetrahedra& tetrahedra)
      : Base(points, tetrahedra), written(&points)
    {}

    void set_point(std::size_t v, const Point_& p) const
    {
      (*written)[v] = Point_(p[0], p[1], p[2]);
    }
  };

  Points points;
  Solid::Tetrahedra tetrahedra;
  Scenario fixed;

  Solid_of()
  {
    const Solid solid;
    for(const Point& p : solid.points)
      points.emplace_back(p.x(), p.y(), p.z());
    tetrahedra = solid.tetrahedra;
    fixed = solid.fixed;
  }

  Domain domain() { return Domain(points, tetrahedra); }
  std::vector<std::size_t> vertices() const { return numbers(points.size()); }
  const Point_& point(std::size_t v) const { return points[v]; }
};

void test_points()
{
  Fault_statistics statistics("copies of points");
  using Session_ = Session<Solid_of<Faulty_point>>;
  test_stories(Fault_test<Session_>(point_faults, statistics), "points", Cell_scheme::elements());
  test_story_of_undo(Fault_test<Session_>(point_faults, statistics), "points, undo");
}

// A vertex that cannot be inserted leaves no point behind that restore() would take for another's.
void test_undo_after_failed_insertion()
{
  test_case() = "undo after an insertion that failed";
  bool has_thrown = true;
  for(std::size_t first = 0; has_thrown; ++first)
  {
    Solid_of<Copied_point> solid;
    CGAL::ARAP_deformation d(solid.domain());
    for(std::size_t v = 0; v < 8; ++v)
      d.insert_roi_vertex(v);
    d.insert_control_vertex(0);
    CHECK(d.preprocess()); // which keeps the rest shape of the vertices around
    const auto state = d.state();
    const std::size_t inserted[] = {8, 9};
    for(std::size_t v : inserted)
      solid.points[v] = Copied_point(10 + double(v), 0, 0);
    has_thrown = throws(point_faults, first, [&] { d.insert_roi_vertex(inserted[0]); });
    CHECK(has_thrown || first > 3);
    CHECK(d.insert_roi_vertex(inserted[1]));
    CHECK(d.restore(state));
    for(std::size_t v : inserted)
      CHECK(solid.points[v][0] == 10 + double(v));
  }
}

// A control point that cannot be inserted leaves no vertex behind that reset() would move.
void test_reset_after_failed_insertion()
{
  test_case() = "reset after an insertion that failed";
  bool has_thrown = true;
  for(std::size_t first = 0; has_thrown; ++first)
  {
    Solid_of<Faulty_point> solid;
    CGAL::ARAP_deformation d(solid.domain());
    d.insert_roi_vertex(0);
    has_thrown = throws(point_faults, first, [&] {
      CHECK(d.insert_control_point(solid.tetrahedra.size() - 1, {0.1, 0.2, 0.3, 0.4}));
    });
    if(!has_thrown)
      break;
    for(std::size_t v = 1; v < solid.points.size(); ++v)
      solid.points[v] = Faulty_point(10 + double(v), 0, 0);
    CHECK(d.roi_vertices().size() == 1);
    d.reset();
    for(std::size_t v = 1; v < solid.points.size(); ++v)
      CHECK(solid.points[v][0] == 10 + double(v));
    CHECK(d.insert_control_point(solid.tetrahedra.size() - 1, {0.1, 0.2, 0.3, 0.4}));
    CHECK(d.roi_vertices().size() == 5);
    CHECK(first < 100);
  }
}

// Points that others have moved are all seen by the run after one that a copy of a point stopped.
template <typename Point_>
void test_points_of_others_after_faults()
{
  test_case() = "points of others after a fault";
  bool has_thrown = true;
  for(std::size_t first = 0; has_thrown; ++first)
  {
    Solid_of<Point_> solid;
    CGAL::ARAP_deformation d(solid.domain());
    d.insert_roi_vertices(solid.vertices());
    for(std::size_t v : {0, 1, 2, 3})
      d.insert_control_vertex(v);
    d.translate(0, Eigen::Vector3d(0.1, 0.2, 0.3)); // not rigidly
    CGAL::ARAP::Options options = d.options();
    options.initial_guess = CGAL::ARAP::Initial_guess::previous;
    CHECK(d.set_options(options) && d.deform(1, 0));
    const std::size_t moved[] = {8, 9};
    for(std::size_t v : moved)
      solid.points[v] = Point_(10 + double(v), 0, 0);
    has_thrown = throws(point_faults, first, [&] { static_cast<void>(d.deform(0, 0)); });
    CHECK(has_thrown || first > 3);
    CHECK(d.deform(0, 0));
    for(std::size_t v : moved)
      CHECK(solid.points[v][0] == 10 + double(v));
  }
}

// the points of a surface, which may fail to be read and written
struct Faulty_point_map
{
  using Map = boost::property_map<Mesh, CGAL::vertex_point_t>::type;
  using key_type = Mesh::Vertex_index;
  using value_type = Point;
  using reference = Point;
  using category = boost::read_write_property_map_tag;

  Map map;

  friend Point get(const Faulty_point_map& points, key_type v)
  {
    throw_if_hit(domain_faults);
    return get(points.map, v);
  }

  friend void put(const Faulty_point_map& points, key_type v, const Point& p)
  {
    throw_if_hit(put_faults);
    put(points.map, v, p);
  }
};

// weights of halfedges that depend on the points
struct Faulty_calculator
{
  template <typename Halfedge, typename PointMap>
  double operator()(Halfedge h, Mesh& mesh, const PointMap& points) const
  {
    throw_if_hit(weight_faults);
    return 1 + squared_distance(get(points, source(h, mesh)), get(points, target(h, mesh)));
  }
};

// What was written before a point could not be is not taken for points that others have moved; and
// those are seen again after all were written.
void test_points_after_faults()
{
  test_case() = "points after a fault in writing";
  Mesh mesh = make_mesh<Mesh>(grid("sheet", 6, 6, [](double u, double v) {
    return Eigen::Vector3d(6 * u, 6 * v, 0);
  }));
  const auto points = get(CGAL::vertex_point, mesh);
  CGAL::ARAP_deformation d(mesh, CGAL::parameters::vertex_point_map(Faulty_point_map{points}));
  d.insert_roi_vertices(vertices(mesh));
  const Mesh::Vertex_index fixed(0), moved(48), other(24);
  d.insert_control_vertex(fixed);
  d.insert_control_vertex(moved);
  CHECK(d.translate(moved, Kernel::Vector_3(0, 0, 2)));
  CHECK(d.deform(5, 0));
  const auto state = d.state();
  CHECK(d.translate(moved, Kernel::Vector_3(0, 3, 2)));
  CHECK(d.deform(5, 0));

  CGAL::ARAP::Options options = d.options();
  options.initial_guess = CGAL::ARAP::Initial_guess::previous;
  CHECK(d.set_options(options));
  const std::vector<Point> before = points_of(mesh);
  const auto check_fault = [&](const auto& call) {
    CHECK(throws(put_faults, 30, call) && points_of(mesh) != before);
  };
  const auto restore = [&] { CHECK(d.restore(state)); };
  const auto reset = [&] { d.reset(); };
  check_fault(restore);
  CHECK(d.deform(0, 0) && points_of(mesh) == before);
  check_fault(reset);
  CHECK(d.deform(0, 0) && points_of(mesh) == before);

  // a vertex that was written, and leaves the region of interest before the next run
  CHECK(d.translate(moved, Kernel::Vector_3(0, 3, 2)));
  check_fault([&] { static_cast<void>(d.deform(5, 0)); });
  const Mesh::Vertex_index left(10);
  CHECK(mesh.point(left) != before[10]);
  d.erase_roi_vertex(left);
  CHECK(d.deform(0, 0) && mesh.point(left) == before[10]);
  CHECK(d.restore(state));

  const auto check_seen = [&](const auto& call) {
    check_fault([&] { static_cast<void>(d.deform(5, 0)); });
    call();
    CHECK(d.translate(moved, Kernel::Vector_3(0, 3, 2))); // not rigidly
    const Point place(1, 2, 30);
    put(points, other, place);
    CHECK(d.deform(0, 0) && mesh.point(other) == place);
  };
  check_seen(restore);
  check_seen(reset);
}

void test_drop_in_class()
{
  using Deformation =
    CGAL::ARAP::Surface_mesh_deformation<Mesh, CGAL::Default, CGAL::Default, CGAL::SPOKES_AND_RIMS,
                                         Faulty_calculator, Faulty_solver, Faulty_rotation,
                                         Faulty_point_map>;
  using Session_ = Drop_in_session<Deformation>;
  const auto construct = [](Session_& s) {
    Mesh& mesh = s.deformed.mesh;
    s.deformation.emplace(mesh, get(boost::vertex_index, mesh), get(boost::halfedge_index, mesh),
                          Faulty_point_map{get(CGAL::vertex_point, mesh)});
    return true;
  };
  Fault_statistics statistics("models of the drop-in class"), put("its writing points");
  failure_of_solver = Failure::returns_false;
  for(Faults* faults : {&solver_faults, &weight_faults, &rotation_faults, &domain_faults})
    test_drop_in_story(Fault_test<Session_>(*faults, statistics), "drop-in class", construct);
  test_drop_in_story(Fault_test<Session_>(put_faults, put, false), "drop-in class, writing",
                     construct);
}

int main()
{
  test_models();
  test_visitors();
  test_domain();
  test_points();
  test_undo_after_failed_insertion();
  test_reset_after_failed_insertion();
  test_points_of_others_after_faults<Faulty_point>();
  test_points_of_others_after_faults<Copied_point>();
  test_points_after_faults();
  test_drop_in_class();
  return faults_result();
}
