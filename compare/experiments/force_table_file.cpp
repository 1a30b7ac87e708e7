#include "compare/experiments/force_table_file.hpp"

#include <array>

#include "dem/archive/hdf5.hpp"

namespace soilbin::compare {
std::string hdf5_of(const ForceTable& table, const TableFileAbout& about) {
  namespace hdf5 = dem::hdf5;
  hdf5::OutputFile file(about.name);
  const hdf5::Group& root = file.root();
  root.set_text("format", "soilbin-force-table/1");
  root.set_text("soilbin", about.version);
  root.set_text("tire", table.question.scenario.tire.name);
  root.set_text("soil", table.question.scenario.soil.name);
  root.set_text("model", table.nodes.choice.label);
  root.set_text("case", about.resolved_case);
  const hdf5::Group axes = root.create("axes"), values = root.create("values"), errors = root.create("std_errors"),
                    interpolation = root.create("interpolation");
  hdf5::Shape shape;
  std::string order;
  for (const TableAxis& axis : table.axes) {
    const std::string name(axis.view->name);
    axes.write(name, hdf5::Number::f64, {axis.nodes.size()}, axis.nodes.data());
    axes.set_free_text("unit", si_unit_of(*axis.view), name);
    shape.push_back(axis.nodes.size());
    order += (order.empty() ? "" : " ") + name;
  }
  root.set_text("axes", order);
  for (const TableChannel& channel : table.channels) {
    const std::string name(channel.channel->name);
    values.write(name, hdf5::Number::f64, shape, channel.values.data());
    errors.write(name, hdf5::Number::f64, shape, channel.std_errors.data());
    const std::array<double, 2> measured = {channel.largest_error, channel.rms_error};
    interpolation.write(name, hdf5::Number::f64, {measured.size()}, measured.data());
    for (const hdf5::Group* group : {&values, &errors, &interpolation})
      group->set_free_text("unit", channel.channel->si_unit, name);
  }
  return std::string(file.finish());
}

}  // namespace soilbin::compare
