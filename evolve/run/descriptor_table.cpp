#include "evolve/run/descriptor_table.h"

#include <cmath>

namespace metamorph::evolve {

std::string descriptor_columns() {
  std::string sql;
  for (const DescriptorField& field : descriptor_fields) {
    sql.append(sql.empty() ? "" : ", ").append(field.name).append(" REAL");
  }
  return sql;
}

std::string descriptor_insertion() {
  std::string places = "?, ?, ?";
  for (std::size_t f = 0; f < descriptor_fields.size(); ++f) places += ", ?";
  return "INSERT INTO descriptors VALUES (" + places + ")";
}

void bind_descriptors(Statement& statement, const TrialDescriptors& descriptors) {
  for (const DescriptorField& field : descriptor_fields) {
    const double value = descriptors.*field.member;
    if (std::isnan(value)) {
      statement.bind_null();
    } else {
      statement.bind(value);
    }
  }
}

}  // namespace metamorph::evolve
