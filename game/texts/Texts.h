// All texts that the game writes on the screen, in each of its languages. The English text is the key, as in
// gettext; a key that has no row here does not compile. Command line, log and error messages stay English.
#pragma once

#include <fmt/core.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace shoal::game {

enum class Language { English, German, French };

using TextRow = std::array<const char*, 3>; // by Language

// "{}" stands for a number or a name.
inline constexpr auto kTexts = std::to_array<TextRow>({
    // Screens
    {"Dive", "Tauchen", "Plonger"},
    {"Free swim", "Freies Schwimmen", "Nage libre"},
    {"My film or photo", "Mein Film oder Foto", "Mon film ou ma photo"},
    {"Headset", "Headset", "Casque"},
    {"Settings", "Einstellungen", "Réglages"},
    {"How to play", "Spielanleitung", "Comment jouer"},
    {"Field guide", "Bestimmungsbuch", "Guide des espèces"},
    {"Quit", "Beenden", "Quitter"},
    {"Back", "Zurück", "Retour"},
    {"Next", "Weiter", "Suivant"},
    {"Paused", "Pause", "Pause"},
    {"Resume", "Weiter", "Reprendre"},
    {"Start again", "Neu beginnen", "Recommencer"},
    {"Title screen", "Startbildschirm", "Écran-titre"},
    {"Photo mode", "Fotomodus", "Mode photo"},
    {"Dive again", "Noch einmal tauchen", "Replonger"},
    {"The dive is over: {}", "Der Tauchgang ist zu Ende: {}", "La plongée est terminée : {}"},
    {"No clock, no shark: meet the animals.", "Keine Uhr, kein Hai: lerne die Tiere kennen.",
     "Ni chrono ni requin : va à la rencontre des animaux."},
    {"Choose a dive", "Wähle einen Tauchgang", "Choisis une plongée"},
    {"Loading", "Wird geladen", "Chargement"},
    {"Catch fish with your bare hands", "Fang Fische mit bloßen Händen", "Attrape des poissons à mains nues"},

    // Results
    {"Stars in all: {}", "Sterne insgesamt: {}", "Étoiles en tout : {}"},
    {"new", "neu", "nouveau"},
    {"record", "Rekord", "record"},
    {"Your largest", "Dein größter Fang", "Ta plus belle prise"},
    {"{} fish caught", "{} Fische gefangen", "{} poissons attrapés"},
    {"1 fish caught", "1 Fisch gefangen", "1 poisson attrapé"},
    {"{} taken by the shark", "{} vom Hai geraubt", "{} volés par le requin"},
    {"Your best dive yet", "Dein bester Tauchgang bisher", "Ta meilleure plongée"},
    {"Your best dives before: {}", "Deine besten Tauchgänge zuvor: {}",
     "Tes meilleures plongées jusqu’ici : {}"},
    {"Better than last time by {}", "{} mehr als beim letzten Mal", "{} de mieux que la dernière fois"},
    {"Seed {}", "Startwert {}", "Graine {}"},
    {"Catch {} fish", "Fange {} Fische", "Attrape {} poissons"},
    {"Catch {} {}", "Fange {} {}", "Attrape {} {}"},
    {"goal reached", "Ziel erreicht", "objectif atteint"},
    {"Catch {} different species", "Fange {} verschiedene Arten", "Attrape {} espèces différentes"},
    {"Score {} points", "Erreiche {} Punkte", "Marque {} points"},
    {"Catch {} fish and lose none to the shark", "Fange {} Fische und verliere keinen an den Hai",
     "Attrape {} poissons sans que le requin t’en prenne un"},
    {"Catch {} fish within {} seconds", "Fange {} Fische in {} Sekunden",
     "Attrape {} poissons en {} secondes"},
    {"First catch: {}", "Erster Fang: {}", "Première prise : {}"},
    {"Catch {} fish with each hand", "Fange mit jeder Hand {} Fische", "Attrape {} poissons de chaque main"},
    {"Bring fish to feed on a mussel", "Locke mit einer Muschel Fische an",
     "Attire des poissons avec une moule"},
    {"Bring fish to feed on {} mussels", "Locke mit {} Muscheln Fische an",
     "Attire des poissons avec {} moules"},
    {"Turn the shark away with a stone", "Vertreibe den Hai mit einem Stein",
     "Fais fuir le requin avec une pierre"},
    {"Turn the shark away with stones: {}", "Vertreibe den Hai mit Steinen: {}",
     "Fais fuir le requin avec des pierres : {}"},
    {"Take {} {} out of the sea", "Hole {} {} aus dem Meer", "Sors {} {} de la mer"},
    {"Touch {} kinds of animals", "Berühre {} Tierarten", "Touche {} espèces d’animaux"},
    {"Catch {} fish in a row and frighten none in between",
     "Fange {} Fische in Folge, ohne einen zu verscheuchen",
     "Attrape {} poissons d’affilée sans en effrayer un seul"},
    {"Catch {} different species in a row", "Fange {} verschiedene Arten in Folge",
     "Attrape {} espèces différentes d’affilée"},

    // In the dive
    {"Points", "Punkte", "Points"},
    {"Time", "Zeit", "Temps"},
    {"{} caught", "{} gefangen", "{} attrapés"},
    {"Reach for a fish and close your hand on it", "Greif nach einem Fisch und schließe die Hand um ihn",
     "Tends la main vers un poisson et ferme-la sur lui"},
    {"Hold it for a second", "Halte ihn eine Sekunde lang fest", "Tiens-le pendant une seconde"},
    {"Keep what you hold away from the shark", "Halte deinen Fang vom Hai fern",
     "Tiens ta prise à l’écart du requin"},
    {"A fast hand frightens fish", "Eine schnelle Hand verscheucht Fische",
     "Une main rapide effraie les poissons"},
    {"Wait in a fish’s way with an open hand", "Warte mit offener Hand auf dem Weg eines Fischs",
     "Attends, main ouverte, sur le chemin d’un poisson"},
    {"Click: take a picture. Right button: look. {}: move. Wheel: zoom. {}: hands. Esc: back",
     "Klick: Foto. Rechte Taste: umsehen. {}: bewegen. Mausrad: Zoom. {}: Hände. Esc: zurück",
     "Clic : photo. Bouton droit : regarder. {} : se déplacer. Molette : zoom. {} : mains. Échap : retour"},
    {"A: take a picture. Left stick: look. Right stick: move. Y: hands. B: back",
     "A: Foto. Linker Stick: umsehen. Rechter Stick: bewegen. Y: Hände. B: zurück",
     "A : photo. Stick gauche : regarder. Stick droit : se déplacer. Y : mains. B : retour"},
    {"Left stick", "Linker Stick", "Stick gauche"},
    {"Right stick, slowly: a fast hand frightens fish",
     "Rechter Stick, langsam: Eine schnelle Hand verscheucht Fische",
     "Stick droit, lentement : une main rapide effraie les poissons"},
    {"Hold the right trigger for one second", "Halte den rechten Trigger eine Sekunde lang",
     "Maintiens la gâchette droite pendant une seconde"},
    {"Look around", "Sieh dich um", "Regarde autour de toi"},
    {"Turn your head", "Dreh den Kopf", "Tourne la tête"},
    {"Arrow keys, or hold the right mouse button and move",
     "Pfeiltasten, oder Maus mit gedrückter rechter Taste",
     "Flèches, ou souris avec le bouton droit enfoncé"},
    {"Reach for a fish until it glows", "Greif nach einem Fisch, bis er leuchtet",
     "Tends la main vers un poisson jusqu’à ce qu’il s’illumine"},
    {"Move the mouse slowly: a fast hand frightens fish",
     "Bewege die Maus langsam: Eine schnelle Hand verscheucht Fische",
     "Bouge la souris lentement : une main rapide effraie les poissons"},
    {"Move slowly: a fast hand frightens fish", "Bewege dich langsam: Eine schnelle Hand verscheucht Fische",
     "Bouge lentement : une main rapide effraie les poissons"},
    {"Close your hand and hold the fish", "Schließe die Hand und halte den Fisch",
     "Ferme la main et tiens le poisson"},
    {"Hold the left mouse button for one second", "Halte die linke Maustaste eine Sekunde lang",
     "Maintiens le bouton gauche de la souris pendant une seconde"},
    {"For one second", "Eine Sekunde lang", "Pendant une seconde"},
    {"Well caught! Now for real: 90 seconds", "Gut gefangen! Jetzt gilt’s: 90 Sekunden",
     "Bien attrapé ! Et maintenant, pour de vrai : 90 secondes"},
    {"Skip the first steps", "Erste Schritte überspringen", "Passer les premiers pas"},
    {"Show the first steps", "Erste Schritte zeigen", "Montrer les premiers pas"},
    {"Sound {} %", "Ton {} %", "Son {} %"},
    {"New in your field guide: {}", "Neu in deinem Bestimmungsbuch: {}", "Nouveau dans ton guide : {}"},
    {"Fish swim past and look at you. Touch them: the field guide remembers every animal that you meet.",
     "Fische schwimmen vorbei und sehen dich an. Berühre sie: Das Bestimmungsbuch merkt sich jedes Tier, "
     "das du triffst.",
     "Les poissons passent et te regardent. Touche-les : le guide retient chaque animal rencontré."},

    // Notices
    {"Hands: {}", "Hände: {}", "Mains : {}"},
    {"{} was not found: the mouse moves the hands", "{} wurde nicht gefunden: Die Maus führt die Hände",
     "{} est introuvable : la souris guide les mains"},
    {"The headset has lost your place: for now you can only look around",
     "Das Headset erkennt nicht, wo du bist: Du kannst dich nur umsehen",
     "Le casque ne sait plus où tu es : tu peux seulement regarder autour de toi"},
    {"Before the webcam can find your hands, run this once: {}",
     "Damit die Webcam deine Hände findet, führe einmal aus: {}",
     "Pour que la webcam trouve tes mains, exécute une fois : {}"},
    {"The film is damaged here: its last good picture stays",
     "Der Film ist hier beschädigt: Das letzte gute Bild bleibt stehen",
     "Le film est abîmé ici : la dernière bonne image reste affichée"},
    {"The live video has stopped: its last picture stays",
     "Das Live-Video ist stehen geblieben: Das letzte Bild bleibt",
     "La vidéo en direct s’est arrêtée : la dernière image reste affichée"},
    {"The live video is lost: its last picture stays until it comes back",
     "Das Live-Video ist unterbrochen: Das letzte Bild bleibt, bis es wiederkommt",
     "La vidéo en direct est coupée : la dernière image reste jusqu’à son retour"},
    {"Saved, together with a 360-degree picture: {}", "Gespeichert, dazu ein 360-Grad-Bild: {}",
     "Enregistré, avec une image à 360 degrés : {}"},
    {"Saved without its 360-degree picture: {}", "Ohne das 360-Grad-Bild gespeichert: {}",
     "Enregistré sans son image à 360 degrés : {}"},
    {"Not saved: {}", "Nicht gespeichert: {}", "Pas enregistré : {}"},
    {"This headset cannot show your own room", "Dieses Headset kann dein Zimmer nicht zeigen",
     "Ce casque ne peut pas montrer ta pièce"},

    // Performance
    {"frame {} ms median, {} worst of 120", "Bild {} ms im Mittel, {} am längsten von 120",
     "image {} ms médiane, {} au pire de 120"},
    {"light {} ms, decode {} ms (own thread)", "Licht {} ms, Decodieren {} ms (eigener Thread)",
     "lumière {} ms, décodage {} ms (fil séparé)"},
    {"upload {} ms, simulation {} ms", "Hochladen {} ms, Simulation {} ms", "envoi {} ms, simulation {} ms"},
    {"{} {} ms on the graphics side", "{} {} ms auf der Grafikseite", "{} {} ms côté graphique"},
    {"draws {}, triangles {}", "Zeichenaufrufe {}, Dreiecke {}", "appels {}, triangles {}"},
    {"drawn at {} % of the size, light every {} of the video’s frames",
     "mit {} % der Größe gezeichnet, Licht mit jedem {}. Bild des Videos",
     "dessiné à {} % de la taille, lumière toutes les {} images"},
    {"light: {}", "Licht: {}", "lumière : {}"},
    {"What the webcam sees; it stays on this machine", "Was die Webcam sieht; es bleibt auf diesem Gerät",
     "Ce que voit la webcam ; rien ne quitte cet appareil"},
    {"as measured, GGX prefiltered", "wie gemessen, GGX-vorgefiltert", "telle que mesurée, préfiltrée GGX"},
    {"decoded sRGB, clipped light estimated, GGX prefiltered",
     "sRGB dekodiert, abgeschnittenes Licht geschätzt, GGX-vorgefiltert",
     "sRGB décodé, lumière écrêtée estimée, préfiltrée GGX"},
    {"decoded sRGB, GGX prefiltered", "sRGB dekodiert, GGX-vorgefiltert", "sRGB décodé, préfiltrée GGX"},
    {"thesis inverse tone mapping, GGX prefiltered",
     "inverse Tonabbildung der Masterarbeit, GGX-vorgefiltert",
     "mappage tonal inverse du mémoire, préfiltrée GGX"},
    {"inverse tone mapping by Akyuz, GGX prefiltered", "inverse Tonabbildung nach Akyuz, GGX-vorgefiltert",
     "mappage tonal inverse d’Akyuz, préfiltrée GGX"},
    {"inverse tone mapping by Landis, GGX prefiltered", "inverse Tonabbildung nach Landis, GGX-vorgefiltert",
     "mappage tonal inverse de Landis, préfiltrée GGX"},
    {"background", "Hintergrund", "arrière-plan"},
    {"objects", "Objekte", "objets"},
    {"particles", "Teilchen", "particules"},
    {"shadows", "Schatten", "ombres"},
    {"overlay", "Schrift", "texte"},

    // How to play
    {"Reach with the mouse. When a fish glows, hold the left button: your hand closes. Hold the fish for a "
     "second, and it counts.",
     "Greif mit der Maus. Leuchtet ein Fisch auf, halte die linke Taste gedrückt: Deine Hand schließt sich. "
     "Halte den Fisch eine Sekunde, dann zählt er.",
     "Tends la main avec la souris. Quand un poisson s’illumine, maintiens le bouton gauche : ta main se "
     "ferme. Tiens le poisson une seconde, et il compte."},
    {"The mouse wheel reaches nearer or farther. Look around with the arrow keys or with the right button "
     "held. Tab swaps hands.",
     "Mit dem Mausrad greifst du näher oder weiter. Sieh dich mit den Pfeiltasten oder mit gedrückter "
     "rechter Maustaste um. Tab wechselt die Hand.",
     "Avec la molette, tu tends la main plus ou moins loin. Regarde autour de toi avec les flèches ou en "
     "maintenant le bouton droit. Tab change de main."},
    {"With a gamepad, look with the left stick, reach with the right one and close your hand with the right "
     "trigger.",
     "Mit dem Gamepad siehst du dich mit dem linken Stick um, greifst mit dem rechten und schließt die Hand "
     "mit dem rechten Trigger.",
     "À la manette, le stick gauche sert à regarder, le stick droit à tendre la main et la gâchette droite à "
     "la fermer."},
    {"Fish fear a fast hand and are curious about one that keeps still: move slowly, or wait in their way.",
     "Fische fürchten schnelle Hände und sind neugierig auf ruhige: Bewege dich langsam, oder warte auf "
     "ihrem Weg.",
     "Une main rapide effraie les poissons, une main immobile les intrigue : bouge lentement, ou attends sur "
     "leur chemin."},
    {"Hold a mussel until it cracks, and fish come to feed. A stone thrown at the shark’s head turns it "
     "away. Take bottles out of the sea.",
     "Halte eine Muschel, bis sie aufbricht, und Fische kommen zum Fressen. Ein Stein an den Kopf vertreibt "
     "den Hai. Hol Flaschen aus dem Meer.",
     "Tiens une moule jusqu’à ce qu’elle s’ouvre, et des poissons viennent manger. Une pierre lancée à la "
     "tête du requin le fait fuir. Sors les bouteilles de la mer."},
    {"A struggling fish draws the shark. When it points at your hand, let go or pull your hand away.",
     "Zappelnde Fische locken den Hai an. Nimmt er deine Hand ins Visier, lass los oder zieh sie weg.",
     "Un poisson qui se débat attire le requin. S’il vise ta main, lâche prise ou retire-la."},
    {"Pause with Esc, the middle mouse button or Start on a gamepad. All keys are in the settings.",
     "Pause machst du mit Esc, der mittleren Maustaste oder Start auf dem Gamepad. Alle Tasten stehen in den "
     "Einstellungen.",
     "Pour faire une pause : Échap, le bouton central de la souris ou Start à la manette. Toutes les touches "
     "sont dans les réglages."},
    {"Different species in a row count double, then three, four and five times. Each dive has three goals. "
     "Jellyfish sting the hand that closes on them.",
     "Verschiedene Arten in Folge zählen doppelt, dann drei-, vier- und fünffach. Jeder Tauchgang hat drei "
     "Ziele. Quallen brennen: Schließ die Hand nicht um sie.",
     "Des espèces différentes à la suite comptent double, puis trois, quatre et cinq fois. Chaque plongée a "
     "trois objectifs. Les méduses piquent la main qui se ferme sur elles."},
    {"Close a hand to go on", "Schließ eine Hand, um weiterzutauchen", "Ferme une main pour continuer"},
    {"Close both hands: dive again", "Beide Hände schließen: noch einmal tauchen",
     "Ferme les deux mains : replonger"},

    // My film or photo
    {"Drop a 360-degree video or any photo on this window, or choose one of these.",
     "Zieh ein 360-Grad-Video oder ein beliebiges Foto auf dieses Fenster, oder wähle eines von diesen.",
     "Dépose une vidéo à 360 degrés ou une photo sur cette fenêtre, ou choisis parmi celles-ci."},
    {"To add some, put them in one of these folders: {}", "Leg weitere in einen dieser Ordner: {}",
     "Pour en ajouter, mets-les dans l’un de ces dossiers : {}"},
    {"Videos: MP4, MKV, WebM, MOV. Photos: JPEG, PNG, WebP, TIFF, AVIF. High dynamic range: HDR, EXR, PFM.",
     "Videos: MP4, MKV, WebM, MOV. Fotos: JPEG, PNG, WebP, TIFF, AVIF. Hoher Dynamikumfang: HDR, EXR, PFM.",
     "Vidéos : MP4, MKV, WebM, MOV. Photos : JPEG, PNG, WebP, TIFF, AVIF. Grande gamme dynamique : HDR, EXR, "
     "PFM."},
    {"There are no films or photos in these folders yet.",
     "In diesen Ordnern sind noch keine Filme oder Fotos.",
     "Il n’y a encore ni film ni photo dans ces dossiers."},
    {"All dives are in {}", "Alle Tauchgänge finden in {} statt", "Toutes les plongées se passent dans {}"},
    {"The dive’s own film", "Der Film des Tauchgangs", "Le film de la plongée"},

    // Keys of the menus
    {"Arrow keys and Enter, mouse or gamepad", "Pfeiltasten und Eingabe, Maus oder Gamepad",
     "Flèches et Entrée, souris ou manette"},

    {"Poke with a fingertip, or pull a controller’s trigger",
     "Tipp mit einem Finger darauf, oder drück den Trigger eines Controllers",
     "Touche du bout du doigt, ou presse la gâchette d’une manette"},

    // Pages of settings
    {"Hands", "Hände", "Mains"},
    {"Comfort", "Komfort", "Confort"},
    {"Picture", "Bild", "Image"},
    {"Sound", "Ton", "Son"},
    {"Text and captions", "Text und Untertitel", "Texte et sous-titres"},
    {"Keys and buttons", "Tasten und Knöpfe", "Touches et boutons"},

    // Hand size
    {"Measure my hand", "Meine Hand messen", "Mesurer ma main"},
    {"Hand size", "Handgröße", "Taille de la main"},
    {"Hold one open hand still, palm towards the camera and 30 cm away from it: the length of a sheet of A4 "
     "paper.",
     "Halte eine offene Hand still, die Handfläche zur Kamera, 30 cm von ihr entfernt: So lang ist ein Blatt "
     "A4.",
     "Garde une main ouverte immobile, paume vers la caméra, à 30 cm d’elle : la longueur d’une feuille A4."},
    {"Keep it there", "Halte sie dort", "Garde-la ainsi"},
    {"No hand is that small or that big: is it 30 cm away?",
     "So klein oder groß ist keine Hand: Ist sie 30 cm entfernt?",
     "Aucune main n’est si petite ou si grande : est-elle à 30 cm ?"},
    {"Your hand has {} % of the usual size.", "Deine Hand hat {} % der üblichen Größe.",
     "Ta main fait {} % de la taille habituelle."},

    // Settings
    {"Hand size (webcam)", "Handgröße (Webcam)", "Taille de la main (webcam)"},
    {"Hand tracking", "Handerkennung", "Suivi des mains"},
    {"Dominant hand", "Bevorzugte Hand", "Main dominante"},
    {"Skin", "Haut", "Peau"},
    {"Mouse sensitivity", "Mausempfindlichkeit", "Sensibilité de la souris"},
    {"Invert up and down", "Hoch und runter vertauschen", "Inverser haut et bas"},
    {"Close the hand by", "Hand schließen durch", "Fermer la main"},
    {"Help with catching", "Hilfe beim Fangen", "Aide pour attraper"},
    {"Help with depth", "Hilfe bei der Tiefe", "Aide pour la profondeur"},
    {"Vibration strength", "Vibrationsstärke", "Force des vibrations"},
    {"Turning", "Drehen", "Rotation"},
    {"Dark edges while turning", "Dunkle Ränder beim Drehen", "Bords sombres en rotation"},
    {"Posture", "Haltung", "Posture"},
    {"seated", "sitzend", "assise"},
    {"standing", "stehend", "debout"},
    {"Reduced motion", "Weniger Bewegung", "Mouvement réduit"},
    {"Specks in the water", "Schwebeteilchen im Wasser", "Particules dans l’eau"},
    {"Game speed", "Spieltempo", "Vitesse du jeu"},
    {"Picture quality", "Bildqualität", "Qualité de l’image"},
    {"Field of view", "Sichtfeld", "Champ de vision"},
    {"Animals in the film", "Tiere im Film", "Animaux dans le film"},
    {"Film size", "Filmgröße", "Taille du film"},
    {"full", "voll", "complète"},
    {"Fullscreen", "Vollbild", "Plein écran"},
    {"Your own room", "Dein Zimmer", "Ta pièce"},
    {"Stereo", "Stereo", "Stéréo"},
    {"Technical details", "Technische Angaben", "Détails techniques"},
    {"Volume", "Lautstärke", "Volume"},
    {"Effects volume", "Effektlautstärke", "Volume des effets"},
    {"Music volume", "Musiklautstärke", "Volume de la musique"},
    {"Music in free swim", "Musik beim freien Schwimmen", "Musique en nage libre"},
    {"Film volume", "Filmlautstärke", "Volume du film"},
    {"Headphones", "Kopfhörer", "Casque audio"},
    {"Captions", "Untertitel", "Sous-titres"},
    {"Caption size", "Größe der Untertitel", "Taille des sous-titres"},
    {"Text size", "Textgröße", "Taille du texte"},
    {"High contrast", "Hoher Kontrast", "Contraste élevé"},
    {"Language", "Sprache", "Langue"},

    // Keys and buttons
    {"Close the hand", "Hand schließen", "Fermer la main"},
    {"Look left", "Nach links sehen", "Regarder à gauche"},
    {"Look right", "Nach rechts sehen", "Regarder à droite"},
    {"Look up", "Nach oben sehen", "Regarder vers le haut"},
    {"Look down", "Nach unten sehen", "Regarder vers le bas"},
    {"Reach farther", "Weiter greifen", "Tendre plus loin"},
    {"Reach nearer", "Näher greifen", "Tendre moins loin"},
    {"Swap hands", "Hand wechseln", "Changer de main"},
    {"Recentre view", "Blick zentrieren", "Recentrer la vue"},
    {"Pause", "Pause", "Pause"},
    {"Louder", "Lauter", "Plus fort"},
    {"Quieter", "Leiser", "Moins fort"},
    {"Press a key or a button for “{}”. Esc: cancel",
     "Drück eine Taste oder einen Knopf für „{}“. Esc: abbrechen",
     "Appuie sur une touche ou un bouton pour « {} ». Échap : annuler"},
    {"Until now it was for “{}”, which still has: {}", "Bisher war sie für „{}“; dafür bleibt: {}",
     "Jusqu’ici, elle servait à « {} », qui garde : {}"},
    {"Until now it was for “{}”, which has no key or button any more",
     "Bisher war sie für „{}“; dafür gibt es jetzt keine Taste mehr",
     "Jusqu’ici, elle servait à « {} », qui n’a plus de touche"},
    {"Reset all keys", "Alle Tasten zurücksetzen", "Réinitialiser les touches"},

    // Names of keys; those with one letter or a number need none
    {"Space", "Leertaste", "Espace"},
    {"Escape", "Esc", "Échap"},
    {"Enter", "Eingabe", "Entrée"},
    {"Tab", "Tab", "Tab"},
    {"Backspace", "Rücktaste", "Retour arrière"},
    {"Insert", "Einfg", "Inser"},
    {"Delete", "Entf", "Suppr"},
    {"Right", "Rechts", "Droite"},
    {"Left", "Links", "Gauche"},
    {"Down", "Runter", "Bas"},
    {"Up", "Hoch", "Haut"},
    {"PageUp", "Bild hoch", "Page préc."},
    {"PageDown", "Bild runter", "Page suiv."},
    {"Home", "Pos1", "Début"},
    {"End", "Ende", "Fin"},
    {"Plus", "Plus", "Plus"},
    {"Minus", "Minus", "Moins"},
    {"Keypad+", "Ziffernblock +", "Pavé +"},
    {"Keypad-", "Ziffernblock -", "Pavé -"},
    {"KeypadEnter", "Ziffernblock Eingabe", "Pavé Entrée"},
    {"LeftShift", "Umschalt links", "Maj gauche"},
    {"RightShift", "Umschalt rechts", "Maj droite"},
    {"LeftControl", "Strg links", "Ctrl gauche"},
    {"RightControl", "Strg rechts", "Ctrl droite"},
    {"LeftAlt", "Alt links", "Alt gauche"},
    {"RightAlt", "Alt rechts", "Alt droite"},
    {"PadUp", "Steuerkreuz hoch", "Croix haut"},
    {"PadRight", "Steuerkreuz rechts", "Croix droite"},
    {"PadDown", "Steuerkreuz runter", "Croix bas"},
    {"PadLeft", "Steuerkreuz links", "Croix gauche"},

    // Values of settings
    {"on", "an", "oui"},
    {"off", "aus", "non"},
    {"automatic", "automatisch", "automatique"},
    {"mouse", "Maus", "souris"},
    {"Leap Motion", "Leap Motion", "Leap Motion"},
    {"webcam", "Webcam", "webcam"},
    {"left", "links", "gauche"},
    {"right", "rechts", "droite"},
    {"light", "hell", "claire"},
    {"medium", "mittel", "moyenne"},
    {"dark", "dunkel", "foncée"},
    {"glove", "Handschuh", "gant"},
    {"hold", "Halten", "maintenir"},
    {"toggle", "Umschalten", "basculer"},
    {"none", "keine", "aucune"},
    {"normal", "normal", "normale"},
    {"strong", "stark", "forte"},
    {"smooth", "gleitend", "continue"},
    {"in steps", "in Schritten", "par paliers"},
    {"fixed", "fest", "fixe"},
    {"sharp", "scharf", "nets"},
    {"as sharp as the film", "so scharf wie der Film", "aussi nets que le film"},
    {"as if filmed", "wie mitgefilmt", "comme filmés"},
    {"side by side", "nebeneinander", "côte à côte"},
    {"small", "klein", "petite"},
    {"large", "groß", "grande"},
    {"English", "English", "English"},
    {"Deutsch", "Deutsch", "Deutsch"},
    {"Français", "Français", "Français"},

    // Captions
    {"a fish flees", "ein Fisch flieht", "un poisson s’enfuit"},
    {"caught", "gefangen", "attrapé"},
    {"it slips away", "er entgleitet", "il s’échappe"},
    {"it struggles", "er zappelt", "il se débat"},
    {"something large passes", "etwas Großes zieht vorbei", "quelque chose de grand passe"},
    {"the last seconds", "die letzten Sekunden", "les dernières secondes"},
    {"the shark is near", "der Hai ist nah", "le requin est proche"},
    {"the shark is after your hand", "der Hai nimmt deine Hand ins Visier", "le requin vise ta main"},
    {"the shark bumps you", "der Hai rempelt dich an", "le requin te heurte"},
    {"the shark bites", "der Hai beißt zu", "le requin mord"},
    {"the dive begins", "der Tauchgang beginnt", "la plongée commence"},
    {"the dive is over", "der Tauchgang ist zu Ende", "la plongée est terminée"},
    {"too far", "zu weit weg", "trop loin"},
    {"too fast", "zu schnell", "trop rapide"},
    {"closed too early", "zu früh geschlossen", "fermée trop tôt"},
    {"behind the fish", "hinter dem Fisch", "derrière le poisson"},
    {"it stings", "es brennt", "ça pique"},
    {"the mussel cracks", "die Muschel bricht auf", "la moule s’ouvre"},
    {"fish come to feed", "Fische kommen zum Fressen", "des poissons viennent manger"},
    {"no fish is near enough to feed", "kein Fisch ist nah genug zum Fressen",
     "aucun poisson n’est assez près pour manger"},
    {"the shark turns away", "der Hai dreht ab", "le requin se détourne"},
    {"out of the sea", "aus dem Meer geholt", "sortie de la mer"},
    {"a whale sings", "ein Wal singt", "une baleine chante"},

    // Field guide
    {"You have met {} of {} animals. Touch an animal in the water to get to know it.",
     "Du kennst {} von {} Tieren. Berühre ein Tier im Wasser, um es kennenzulernen.",
     "Tu connais {} animaux sur {}. Touche un animal dans l’eau pour le découvrir."},

    {"{} stars bring it to you. Dive: {}", "Ab {} Sternen kommt es zu dir. Tauchgang: {}",
     "À partir de {} étoiles, il vient à toi. Plongée : {}"},
    {"Next animal", "Nächstes Tier", "Animal suivant"},
    {"Previous animal", "Voriges Tier", "Animal précédent"},
    {"Caught: {}", "Gefangen: {}", "Prises : {}"},
    {"Longest: {}", "Längster Fang: {}", "La plus longue : {}"},
    {"First met: {}, {}", "Erste Begegnung: {}, {}", "Première rencontre : {}, {}"},

    // Dives
    {"The reef", "Das Riff", "Le récif"},
    {"The reef by night", "Das Riff bei Nacht", "Le récif la nuit"},
    {"The kelp forest", "Der Kelpwald", "La forêt de kelp"},
});

// Names that choices have on the command line, and their English on the screen where it differs.
inline constexpr auto kChoiceNames = std::to_array<std::array<std::string_view, 2>>({
    {"auto", "automatic"},
    {"none", "off"},
    {"leap", "Leap Motion"},
    {"snap", "in steps"},
    {"best", "full"},
    {"plain", "sharp"},
    {"resolution", "as sharp as the film"},
    {"camera", "as if filmed"},
    {"sbs", "side by side"},
    {"english", "English"},
    {"german", "Deutsch"},
    {"french", "Français"},
});

// Returns the index of a text's row; kTexts.size() if it has none.
constexpr size_t findText(std::string_view english) {
    size_t row = 0;
    while (row < kTexts.size() && english != kTexts[row][0]) ++row;
    return row;
}

// A text that has a row in kTexts, made from its English words.
class Text {
  public:
    consteval Text(const char* english) : row_(findText(english)) { (void)kTexts.at(row_); }
    constexpr const char* in(Language language) const { return kTexts[row_][static_cast<size_t>(language)]; }
    // The same with values in place of its "{}".
    template <class... Values> std::string in(Language language, const Values&... values) const {
        return fmt::format(fmt::runtime(in(language)), values...);
    }
    constexpr bool operator==(const Text&) const = default;

  private:
    size_t row_;
};

// One message to the player: a text, and the values that replace its "{}". All messages are of this type.
struct Notice {
    Text text;
    std::string value{}, second{}; // names, numbers or files, in place of the first and second "{}"

    std::string in(Language language) const { return text.in(language, value, second); }
    bool operator==(const Notice&) const = default;
};

// Translates a name from a file or table; one without a row stays as it is.
inline std::string_view translated(std::string_view english, Language language) {
    const size_t row = findText(english);
    return row < kTexts.size() ? kTexts[row][static_cast<size_t>(language)] : english;
}

// The same for the value of a setting, by its name on the command line.
inline std::string_view translatedChoice(std::string_view name, Language language) {
    for (const auto& [choice, english] : kChoiceNames)
        if (choice == name) return translated(english, language);
    return translated(name, language);
}

// Returns the language of a locale such as "de_AT.UTF-8" in LC_ALL; English if the game does not have it.
constexpr Language languageOf(std::string_view locale) {
    if (locale.starts_with("de")) return Language::German;
    if (locale.starts_with("fr")) return Language::French;
    return Language::English;
}

} // namespace shoal::game
