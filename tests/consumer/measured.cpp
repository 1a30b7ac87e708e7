// A user's program: reads an installed campaign.
#include <bekker_wong/effect_vocabulary.hpp>
#include <compare/measured/campaign.hpp>
#include <cstdio>

int main(int count, char** arguments) {
  if (count != 2) return 2;
  const soilbin::compare::Campaign campaign =
      soilbin::compare::read_campaign(arguments[1], soilbin::Library(), soilbin::bekker_wong::CatalogueVocabulary());
  std::printf("%s: %zu runs\n", campaign.name.c_str(), campaign.runs.size());
  return campaign.runs.size() == 90 ? 0 : 1;
}
