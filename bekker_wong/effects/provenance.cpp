#include "bekker_wong/effects/provenance.hpp"

namespace soilbin::bekker_wong {

Provenance provenance_of(const EffectForm& form) {
  if (form.source.starts_with("after ")) return Provenance::after;
  return form.source.starts_with("stated") ? Provenance::stated : Provenance::published;
}

std::string in_words(Provenance provenance) {
  switch (provenance) {
    case Provenance::published:
      return "published";
    case Provenance::after:
      return "after a source";
    case Provenance::stated:
      return "ours";
  }
  return "";
}

}  // namespace soilbin::bekker_wong
