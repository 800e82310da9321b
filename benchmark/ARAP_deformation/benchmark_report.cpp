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

// Makes tables and plots from the results file that the benchmarks write, and adds the peak memory
// of processes to it.

#include "include/run_benchmark.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace benchmark;

Json read_results(const std::string& file)
{
  std::ifstream in(file);
  if(!in)
    throw Failure("cannot read the results " + file + "; run script/bench to make them");
  return Json::parse(in);
}

// calls f for each section that has a table
template <typename Function>
void for_each_section(const Json& results, const Function& f)
{
  for(const auto& [name, section] : results.items())
    if(section.contains("rows"))
      f(section);
}

std::string machine_sentence(const Json& results)
{
  const Json& m = results["machine"];
  const auto text = [&m](const char* key) { return m[key].get<std::string>(); };
  return text("processor") + ", " + m["cores"].dump() + " cores; " + text("compiler") + ", `" +
         text("flags") + "`; " + text("libraries") + "; 1 " +
         (m["threads"] == 1 ? "thread." : "and " + m["threads"].dump() + " threads.");
}

// one line for each figure that a user may compare with another machine or another package
Json make_summary(const Json& results)
{
  Json summary = make_section("Summary", "With the default solver and all threads.",
                              {{"figure", "figure"}, {"other", "CGAL (tetrahedra: libigl)"},
                               {"ours", "ours"}, {"ratio", "ratio"},
                               {"one_thread_ratio", "ratio, one thread"}});
  // Rows of a section with the same value of `key` are one figure: those of the default solver,
  // with one thread and with all.
  const unsigned int threads = results["machine"]["threads"];
  const auto add = [&](const std::string& section, const std::string& key, const std::string& title,
                       const std::string& other, const std::string& ours,
                       const std::string& ratio,
                       const std::function<bool(const Json&)>& is_wanted) {
    if(!results.contains(section))
      return;
    std::vector<Json> figures;
    for(const Json& row : results[section]["rows"])
    {
      if(!is_wanted(row) || !row.contains(ratio) || row.value("solver", "default") != "default")
        continue;
      const std::string figure = title + format_cell(row, key);
      auto found = std::find_if(figures.begin(), figures.end(),
                                [&](const Json& f) { return f["figure"] == figure; });
      if(found == figures.end())
        found = figures.insert(found, Json{{"figure", figure}});
      if(row.value("threads", threads) == threads)
        found->update({{"other", row[other]}, {"ours", row[ours]}, {"ratio", row[ratio]}});
      if(row.value("threads", 0u) == 1)
        (*found)["one_thread_ratio"] = row[ratio];
    }
    for(const Json& figure : figures)
      summary["rows"].push_back(figure);
  };
  const auto all = [](const Json&) { return true; };
  const auto spokes = [](const Json& row) { return row["cells"] == "spokes"; };
  add("iteration_time", "vertices", "iteration [ms], vertices: ", "cgal_iteration_ms",
      "iteration_ms", "iteration_ratio", spokes);
  add("time_to_minimum", "gap", "from the rest shape [s], gap: ", "cgal_seconds", "seconds",
      "ratio", all);
  add("iteration_time", "vertices", "preprocessing [ms], vertices: ", "cgal_preprocess_ms",
      "preprocess_ms", "preprocess_ratio", spokes);
  add("peak_memory", "vertices", "peak memory [MB], vertices: ", "cgal_mb", "ours_mb", "ratio",
      all);
  add("handle_changes", "vertices", "other control vertices [ms], vertices: ", "cgal_change_ms",
      "change_ms", "cgal_ratio", all);
  add("frame_rate", "vertices", "frame of a drag [ms], vertices: ", "cgal_median_ms", "median_ms",
      "ratio", [](const Json& row) { return row["deformation"] == "ours"; });
  add("tetrahedra", "tetrahedra", "iteration [ms], tetrahedra: ", "libigl_iteration_ms",
      "iteration_ms", "iteration_ratio", all);
  return summary;
}

// Adds a peak printed by the program peak_memory, of which the mesh alone is the first.
void add_peak(const std::string& file, const std::string& name, double vertices, double megabytes)
{
  if(!std::isfinite(megabytes)) // the system does not tell it
    return;
  Settings settings;
  settings.json_file = file;
  Json section = make_section(
    "Peak memory", "Megabytes of a process that deforms a mesh, the mesh included.",
    {{"vertices", "vertices"}, {"mesh_mb", "the mesh alone"}, {"ours_mb", "ours"},
     {"ours_single_mb", "ours, single precision"}, {"ours_eigen_mb", "ours, Eigen"},
     {"cgal_mb", "CGAL"}, {"libigl_mb", "libigl"}, {"ratio", "CGAL / ours"}});
  Json& rows = section["rows"];
  if(const Json results = read_results(settings); results.contains("peak_memory"))
    rows = results["peak_memory"]["rows"];
  auto row = std::find_if(rows.begin(), rows.end(),
                          [&](const Json& r) { return r["vertices"] == vertices; });
  if(row == rows.end())
  {
    rows.push_back({{"vertices", vertices}});
    row = rows.end() - 1;
  }
  if(name == "mesh")
    *row = {{"vertices", vertices}};
  (*row)[name + "_mb"] = megabytes;
  if(row->contains("ours_mb") && row->contains("cgal_mb"))
    (*row)["ratio"] = (*row)["cgal_mb"].get<double>() / (*row)["ours_mb"].get<double>();
  write_section(settings, "peak_memory", section);
}

// A plot for gnuplot, with its data in the same file.
class Plot
{
public:
  Plot(const std::string& file, const std::string& x, const std::string& y)
  {
    m_head << "reset\n"
           << "set terminal pngcairo size 800,600 font 'Sans,13' linewidth 1.5 background 'white'\n"
           << "set output '" << file << "'\n"
           << "set xlabel '" << x << "'\nset ylabel '" << y << "'\n"
           << "set grid xtics ytics linecolor rgb '#dddddd'\n"
           << "set border 3\nset tics nomirror\n"
           << "set key outside below center horizontal spacing 1.3\n";
  }

  Plot& set(const std::string& line)
  {
    m_head << "set " << line << "\n";
    return *this;
  }

  // each element of `points` has its coordinates at the keys x and y
  void add(const std::string& title, const std::string& style, const Json& points,
           std::size_t x = 0, std::size_t y = 1)
  {
    if(points.empty())
      return;
    const std::string name = "$curve" + std::to_string(m_number_of_curves++);
    m_data << name << " << EOD\n";
    for(const Json& p : points)
      m_data << p[x] << " " << p[y] << "\n";
    m_data << "EOD\n";
    m_curves << (m_number_of_curves > 1 ? ", \\\n     " : "plot ") << name << " using 1:2 title '"
             << title << "' with " << style;
  }

  void print(std::ostream& out) const
  {
    if(m_number_of_curves > 0)
      out << m_data.str() << m_head.str() << m_curves.str() << "\n";
  }

private:
  int m_number_of_curves = 0;
  std::ostringstream m_head, m_data, m_curves;
};

// colors that the color-blind can tell apart: blue for ours, red for CGAL, gray for libigl
const std::string our_color = "linecolor rgb '#0060b0' ";
const std::string cgal_color = "linecolor rgb '#d04020' ";
const std::string libigl_color = "linecolor rgb '#808080' ";
const std::string other_color = "linecolor rgb '#e0a000' ";

std::string threads_name(const Json& results, unsigned int threads)
{
  return threads == 1 || results["machine"]["threads"] == 1
       ? "1 thread" : std::to_string(threads) + " threads";
}

std::vector<unsigned int> thread_counts_of(const Json& results)
{
  const unsigned int threads = results["machine"]["threads"];
  return threads == 1 ? std::vector<unsigned int>{1} : std::vector<unsigned int>{1, threads};
}

// points (x, y) of the selected rows, with the smallest y for each x
Json points_of(const Json& rows, const std::string& x, const std::string& y,
               const std::function<bool(const Json&)>& is_wanted)
{
  Json points = Json::array();
  for(const Json& row : rows)
  {
    if(!row.contains(x) || !row.contains(y) || !is_wanted(row))
      continue;
    const auto found = std::find_if(points.begin(), points.end(),
                                    [&](const Json& p) { return p[0] == row[x]; });
    if(found == points.end())
      points.push_back({row[x], row[y]});
    else if(row[y] < (*found)[1])
      (*found)[1] = row[y];
  }
  return points;
}

void plot_iteration_time(std::ostream& out, const Json& results, const std::string& folder)
{
  if(!results.contains("iteration_time"))
    return;
  Plot plot(folder + "/arap_iteration_time.png", "vertices", "milliseconds for one iteration");
  plot.set("logscale xy").set("format x '%.0s%c'").set("format y '%g'");
  const Json& rows = results["iteration_time"]["rows"];
  const auto spokes = [](const Json& row) { return row["cells"] == "spokes"; };
  plot.add("libigl", "linespoints pointtype 5 " + libigl_color,
           points_of(rows, "vertices", "libigl_iteration_ms", spokes));
  plot.add("CGAL", "linespoints pointtype 7 " + cgal_color,
           points_of(rows, "vertices", "cgal_iteration_ms", spokes));
  for(unsigned int threads : thread_counts_of(results))
  {
    const auto is_wanted = [&](const Json& row) {
      return row["threads"] == threads && (!row.contains("cells") || spokes(row)) &&
             row.value("solver", "default") == "default";
    };
    Json points = points_of(rows, "vertices", "iteration_ms", is_wanted);
    if(results.contains("growth"))
      for(const Json& p : points_of(results["growth"]["rows"], "vertices", "iteration_ms",
                                    is_wanted))
        if(points.empty() || p[0] > points.back()[0])
          points.push_back(p);
    plot.add("this package, " + threads_name(results, threads),
             (threads == 1 ? "linespoints pointtype 9 dashtype 2 " : "linespoints pointtype 9 ") +
             our_color, points);
  }
  plot.print(out);
}

void plot_energy(std::ostream& out, const Json& results, const std::string& folder)
{
  if(!results.contains("time_to_minimum"))
    return;
  const Json& section = results["time_to_minimum"];
  Plot plot(folder + "/arap_time_to_minimum.png", "seconds", "relative gap to the minimum");
  plot.set("logscale xy").set("format y '10^{%L}'").set("format x '%g'").set("yrange [1e-6:]");
  plot.add("CGAL", "lines " + cgal_color, section["cgal_curve"], 1, 2);
  for(unsigned int threads : thread_counts_of(results))
    plot.add("this package, " + threads_name(results, threads),
             (threads == 1 ? "lines dashtype 2 " : "lines ") + our_color,
             section["curve_of_" + std::to_string(threads)], 1, 2);
  plot.print(out);
}

// of the armadillo, for each size
void plot_starts(std::ostream& out, const Json& results, const std::string& folder)
{
  if(!results.contains("starts"))
    return;
  Plot plot(folder + "/arap_starts.png", "seconds", "relative gap to the lowest energy known");
  plot.set("logscale xy").set("format y '10^{%L}'").set("format x '%g'").set("yrange [1e-4:100]");
  plot.set("key maxcols 2");
  const std::string colors[] = {our_color, other_color, cgal_color, libigl_color};
  std::size_t number_of_sizes = 0;
  for(const auto& [name, curves] : results["starts"]["curves"].items())
    if(const std::string shape = "armadillo, spokes, ";
       name.rfind(shape, 0) == 0 && std::isdigit(name[shape.size()]))
    {
      const std::string size = format_number(std::stod(name.substr(shape.size())));
      const std::string& color = colors[number_of_sizes++ % std::size(colors)];
      plot.add(size + ", defaults", "lines " + color, curves["default"]);
      plot.add(size + ", from the rest shape", "lines dashtype 2 " + color, curves["rest shape"]);
      if(curves.contains("default, no coarse start"))
        plot.add(size + ", no coarse start", "lines dashtype 4 " + color,
                 curves["default, no coarse start"]);
      if(curves.contains("default, no coarse metric"))
        plot.add(size + ", no coarse metric", "lines dashtype 3 " + color,
                 curves["default, no coarse metric"]);
    }
  plot.print(out);
}

void plot_roofline(std::ostream& out, const Json& results, const std::string& folder)
{
  if(!results.contains("global_step"))
    return;
  const Json& section = results["global_step"];
  Plot plot(folder + "/arap_roofline.png", "size of the factor [MB]", "GB/s");
  plot.set("logscale xy").set("format x '%g'").set("format y '%g'");
  for(unsigned int threads : thread_counts_of(results))
  {
    const std::string dashes = threads == 1 ? "dashtype 2 " : "";
    plot.add("reading, " + threads_name(results, threads),
             "lines " + dashes + "linecolor rgb '#404040' ",
             section["streaming_of_" + std::to_string(threads)]);
    for(const auto& solver_and_style :
        {std::pair<std::string, std::string>{"default", "pointtype 9 " + our_color},
         {"single precision", "pointtype 5 linecolor rgb '#60a8e0' "},
         {"default, METIS", "pointtype 13 linecolor rgb '#208040' "}})
    {
      const std::string& solver = solver_and_style.first;
      plot.add(solver + ", " + threads_name(results, threads),
               "linespoints " + dashes + solver_and_style.second,
               points_of(section["rows"], "factor_mb", "gb_per_second", [&](const Json& row) {
                 return row["solver"] == "ours, " + solver && row["threads"] == threads;
               }));
    }
  }
  for(const auto& solver_and_color :
      {std::pair<std::string, std::string>{"Eigen LDLT", libigl_color},
       {"CHOLMOD simplicial", other_color}, {"CHOLMOD supernodal", cgal_color}})
    plot.add(solver_and_color.first, "linespoints pointtype 6 " + solver_and_color.second,
             points_of(section["rows"], "factor_mb", "gb_per_second",
                       [&](const Json& row) { return row["solver"] == solver_and_color.first; }));
  plot.print(out);
}

const char usage[] =
  "usage: benchmark_report FILE text              all tables, for a terminal\n"
  "       benchmark_report FILE summary           the most important figures, as Markdown\n"
  "       benchmark_report FILE markdown          all tables, as Markdown\n"
  "       benchmark_report FILE gnuplot FOLDER    plots, for gnuplot's standard input\n"
  "       benchmark_report FILE peak CLASS VERTICES MEGABYTES\n"
  "                                               adds what peak_memory has printed\n";

void report(const std::vector<std::string>& arguments)
{
  const std::string &file = arguments[0], &form = arguments[1];
  if(form == "peak")
  {
    add_peak(file, arguments[2], std::stod(arguments[3]), std::stod(arguments[4]));
    return;
  }
  const Json results = read_results(file);
  if(form == "summary" && results["machine"].value("quick", false))
    throw Failure(file + " has quick results, which are not for publication");
  if(form == "gnuplot")
  {
    plot_iteration_time(std::cout, results, arguments[2]);
    plot_energy(std::cout, results, arguments[2]);
    plot_starts(std::cout, results, arguments[2]);
    plot_roofline(std::cout, results, arguments[2]);
    return;
  }
  std::cout << machine_sentence(results) << "\n";
  if(form == "text")
  {
    for_each_section(results, [](const Json& section) { print_text(std::cout, section); });
    print_text(std::cout, make_summary(results));
    return;
  }
  std::cout << "\n";
  print_markdown(std::cout, make_summary(results));
  if(form == "markdown")
    for_each_section(results, [](const Json& section) {
      std::cout << "\n**" << section["title"].get<std::string>() << ".** "
                << section["description"].get<std::string>() << "\n\n";
      print_markdown(std::cout, section);
    });
}

} // namespace

int main(int argc, char** argv)
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const std::vector<std::pair<std::string, std::size_t>> forms = {
    {"text", 2}, {"summary", 2}, {"markdown", 2}, {"gnuplot", 3}, {"peak", 5}};
  if(std::none_of(forms.begin(), forms.end(), [&](const auto& form) {
       return arguments.size() == form.second && arguments[1] == form.first;
     }))
  {
    std::cerr << usage;
    return 2;
  }
  try
  {
    report(arguments);
  }
  catch(const std::exception& error)
  {
    std::cerr << "benchmark_report: " << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
